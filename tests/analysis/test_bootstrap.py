"""Means, medians, shares and ratios with their intervals against known values."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from testbed.analysis import bootstrap
from testbed.analysis.bootstrap import Estimate, means, medians, sample_of

pytestmark = pytest.mark.versions


def mean(*sample: Any, **labels: Any) -> Estimate | None:
    """Of values, their weights and the labels of their clusters."""
    return bootstrap.bootstrap(means, sample_of(*sample, **labels))


def median(*sample: Any, **labels: Any) -> Estimate | None:
    return bootstrap.bootstrap(medians, sample_of(*sample, **labels))


def proportion(*sample: Any, **labels: Any) -> Estimate | None:
    return bootstrap.proportion(sample_of(*sample, **labels))


def ratio_of_means(above: Any, below: Any) -> Estimate | None:
    return bootstrap.bootstrap(means, sample_of(above), sample_of(below))


def ratio_of_medians(above: Any, below: Any) -> Estimate | None:
    return bootstrap.bootstrap(medians, sample_of(above), sample_of(below))


ESTIMATES = (mean, median, proportion)


def test_the_interval_of_a_mean_is_that_of_the_normal_distribution() -> None:
    sample = np.random.default_rng(5).normal(10.0, 2.0, 400)
    estimate = mean(sample)
    assert estimate is not None
    error = 1.96 * sample.std(ddof=1) / np.sqrt(len(sample))
    assert estimate.value == pytest.approx(sample.mean())
    assert estimate.high - estimate.low == pytest.approx(2 * error, rel=0.12)
    assert mean(sample) == estimate


def test_a_value_counts_as_often_as_its_weight_says() -> None:
    values, weights = np.array([1.0, 3.0, 10.0, 10.0, 10.0]), np.array([3, 3, 1, 1, 1])
    estimate, middle = mean(values, weights), median(values, weights)
    assert estimate is not None
    assert middle is not None
    assert estimate.value == pytest.approx((3 * 4.0 + 30.0) / 9)
    assert middle.value == 3.0
    assert mean([]) is median([]) is proportion([]) is None


def test_where_all_are_right_the_interval_is_the_exact_one() -> None:
    estimate = proportion(np.ones(192), [4.0] * 100 + [1.0] * 92)
    assert estimate is not None
    assert (estimate.value, estimate.high) == (1.0, 1.0)
    assert estimate.low == pytest.approx(0.025 ** (1 / 192))
    mixed = proportion([1.0, 0.0] * 50)
    assert mixed is not None
    assert mixed.low == pytest.approx(0.4, abs=0.03)


@pytest.mark.parametrize("estimate", ESTIMATES)
@settings(max_examples=25)
@given(sample=st.lists(st.integers(0, 1), min_size=1, max_size=20), copies=st.integers(2, 5))
def test_repeats_that_say_nothing_new_make_no_interval_narrower(
    estimate: Callable[..., Estimate | None], sample: list[int], copies: int
) -> None:
    values, labels = np.array(sample, dtype=float), list(range(len(sample)))
    alone = estimate(values)
    repeated = estimate(np.repeat(values, copies), clusters=np.repeat(labels, copies))
    assert alone is not None
    assert repeated is not None
    assert (repeated.value, repeated.low, repeated.high) == pytest.approx(
        (alone.value, alone.low, alone.high)
    )


def test_the_interval_of_clusters_is_that_of_their_means() -> None:
    random = np.random.default_rng(3)
    own, labels = random.normal(5.0, 1.0, 300), np.repeat(np.arange(300), 4)
    values = np.repeat(own, 4) + random.normal(0.0, 0.5, 1200)
    estimate = mean(values, clusters=labels)
    assert estimate is not None
    means = values.reshape(300, 4).mean(axis=1)
    error = 1.96 * means.std(ddof=1) / np.sqrt(300)
    assert estimate.value == pytest.approx(values.mean())
    assert estimate.high - estimate.low == pytest.approx(2 * error, rel=0.12)
    as_if_independent = mean(values)
    assert as_if_independent is not None
    width = as_if_independent.high - as_if_independent.low
    assert width < 0.65 * (estimate.high - estimate.low)


def test_a_cluster_is_drawn_with_all_of_its_values_at_once() -> None:
    values, labels = np.concatenate([np.arange(30.0), -np.arange(30.0)]), list(range(30))
    together = mean(values, clusters=labels * 2)
    assert together == Estimate(0.0, 0.0, 0.0)
    apart = mean(values, clusters=[*labels, *(f"other {label}" for label in labels)])
    assert apart is not None
    assert apart.low < -1.0 < 1.0 < apart.high


@settings(max_examples=50)
@given(st.data())
def test_the_median_of_a_resample_is_that_of_its_values(data: st.DataObject) -> None:
    values = data.draw(st.lists(st.integers(-5, 5), min_size=1, max_size=12))
    size = len(values)
    times = data.draw(st.lists(st.integers(1, 3), min_size=size, max_size=size))
    labels = data.draw(st.lists(st.integers(0, 3), min_size=size, max_size=size))
    unit = data.draw(st.sampled_from([1.0, 0.1, 1 / 3, 4 / 3, 1e15 / 7]))
    sample = bootstrap.sample_of(values, [unit * number for number in times], labels)
    counts = data.draw(
        st.lists(st.integers(0, 3), min_size=sample.clusters, max_size=sample.clusters).filter(any)
    )
    drawn = dict(zip(dict.fromkeys(labels), counts, strict=True))
    rows = zip(values, times, labels, strict=True)
    resample = [value for value, number, label in rows for _ in range(number * drawn[label])]
    weights = np.array([counts])
    assert bootstrap.medians(sample, weights) == pytest.approx([np.median(resample)])
    assert bootstrap.means(sample, weights) == pytest.approx([np.mean(resample)])


def test_the_exact_interval_counts_clusters() -> None:
    estimate = proportion(np.ones(200), clusters=np.repeat(np.arange(50), 4))
    assert estimate is not None
    assert estimate.low == pytest.approx(0.025 ** (1 / 50))


def test_a_rounded_value_may_lie_half_a_digit_outside() -> None:
    estimate = Estimate(1.0, 0.9, 1.1)
    assert estimate.covers(1.104, 0.005)
    assert not estimate.covers(1.106, 0.005)
    assert not estimate.covers(0.89, 0.005)


def test_where_all_are_alike_there_is_nothing_to_resample() -> None:
    assert mean(np.ones(3), [1.0, 2.0, 3.0], ["a", "b", "c"]) == Estimate(1.0, 1.0, 1.0)
    assert mean([1.0, 3.0], [3.0, 1.0], ["a", "a"]) == Estimate(1.5, 1.5, 1.5, single=True)


def test_the_interval_of_a_ratio_of_means_is_that_of_the_delta_method() -> None:
    generator = np.random.default_rng(6)
    above, below = generator.normal(30.0, 3.0, 400), generator.normal(10.0, 2.0, 300)
    estimate = ratio_of_means(above, below)
    assert estimate is not None
    value = above.mean() / below.mean()
    errors = [(s.std(ddof=1) / s.mean()) ** 2 / len(s) for s in (above, below)]
    assert estimate.value == pytest.approx(value)
    width = 2 * 1.96 * value * np.sqrt(sum(errors))
    assert estimate.high - estimate.low == pytest.approx(width, rel=0.12)


def test_ratios_of_known_samples() -> None:
    six, twos = np.array([6.0, 6.0]), np.array([2.0, 2.0, 2.0])
    assert ratio_of_means(six, twos) == Estimate(3.0, 3.0, 3.0)
    # Of three values a resample is the smallest alone with a chance of 1 in 27, more than 2.5%.
    skewed, four = np.array([1.0, 2.0, 9.0]), np.array([4.0])
    assert ratio_of_means(skewed, four) == Estimate(1.0, 0.25, 2.25)
    assert ratio_of_medians(skewed, four) == Estimate(0.5, 0.25, 2.25)


def test_there_is_no_ratio_of_nothing_or_by_nothing() -> None:
    some, none = np.array([1.0]), np.array([])
    assert (
        ratio_of_means(none, some)
        is ratio_of_means(some, none)
        is ratio_of_medians(some, none)
        is None
    )
