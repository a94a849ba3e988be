"""Quotients of two samples against known values and the delta method."""

import numpy as np
import pytest

from testbed.analysis.quotient import of_means, of_medians
from testbed.analysis.statistics import Estimate


def test_the_interval_of_a_quotient_of_means_is_that_of_the_delta_method() -> None:
    generator = np.random.default_rng(6)
    above, below = generator.normal(30.0, 3.0, 400), generator.normal(10.0, 2.0, 300)
    estimate = of_means(above, below)
    assert estimate is not None
    value = above.mean() / below.mean()
    errors = [(s.std(ddof=1) / s.mean()) ** 2 / len(s) for s in (above, below)]
    assert estimate.value == pytest.approx(value)
    width = 2 * 1.96 * value * np.sqrt(sum(errors))
    assert estimate.high - estimate.low == pytest.approx(width, rel=0.12)


def test_quotients_of_known_samples() -> None:
    six, twos = np.array([6.0, 6.0]), np.array([2.0, 2.0, 2.0])
    assert of_means(six, twos) == Estimate(3.0, 3.0, 3.0)
    # Of three values a resample is the smallest alone with a chance of 1 in 27, more than 2.5%.
    skewed, four = np.array([1.0, 2.0, 9.0]), np.array([4.0])
    assert of_means(skewed, four) == Estimate(1.0, 0.25, 2.25)
    assert of_medians(skewed, four) == Estimate(0.5, 0.25, 2.25)


def test_there_is_no_quotient_of_nothing_or_by_nothing() -> None:
    some, none = np.array([1.0]), np.array([])
    assert of_means(none, some) is of_means(some, none) is of_medians(some, none) is None
