"""Estimates, tests and corrections against known values and plain definitions."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from testbed.analysis import resampling
from testbed.analysis.statistics import (
    Estimate,
    Test,
    holm,
    mcnemar,
    mean,
    median,
    proportion,
    signed_rank,
)

pytestmark = pytest.mark.versions

ESTIMATES = (mean, median, proportion)
P_VALUES = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12)


def test_holms_correction_of_four_known_values() -> None:
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    assert holm([]) == []


@given(P_VALUES)
def test_holm_lies_between_no_correction_and_bonferronis(p_values: list[float]) -> None:
    corrected = holm(p_values)
    for before, after in zip(p_values, corrected, strict=True):
        assert before <= after <= min(1.0, len(p_values) * before)
    in_order = sorted(zip(p_values, corrected, strict=True))
    assert all(one[1] <= other[1] for one, other in pairwise(in_order))


@given(P_VALUES, st.floats(0.01, 0.2))
def test_holm_rejects_what_the_step_down_rule_rejects(p_values: list[float], level: float) -> None:
    rejected = set()
    order = sorted(range(len(p_values)), key=lambda i: p_values[i])
    for rank, index in enumerate(order):
        if p_values[index] * (len(p_values) - rank) > level:
            break
        rejected.add(index)
    assert {i for i, p in enumerate(holm(p_values)) if p <= level} == rejected


def test_the_interval_of_a_mean_is_that_of_the_normal_distribution() -> None:
    sample = np.random.default_rng(5).normal(10.0, 2.0, 400)
    estimate = mean([(sample, 1)])
    assert estimate is not None
    error = 1.96 * sample.std(ddof=1) / np.sqrt(len(sample))
    assert estimate.value == pytest.approx(sample.mean())
    assert estimate.high - estimate.low == pytest.approx(2 * error, rel=0.12)
    assert mean([(sample, 1)]) == estimate


def test_a_stratum_counts_as_often_as_it_says() -> None:
    one, other = np.array([1.0, 3.0]), np.array([10.0, 10.0, 10.0])
    estimate = mean([(one, 3), (other, 1)])
    assert estimate is not None
    assert estimate.value == pytest.approx((3 * 4.0 + 30.0) / 9)
    assert (estimate.low, estimate.high) == pytest.approx((4.0, 16.0 / 3))
    middle = median([(one, 3), (other, 1)])
    assert middle is not None
    assert middle.value == 3.0
    assert mean([(np.array([]), 1)]) is None


def test_where_all_are_right_the_interval_is_the_exact_one() -> None:
    estimate = proportion([(np.ones(100), 4), (np.ones(92), 1)])
    assert estimate is not None
    assert (estimate.value, estimate.high) == (1.0, 1.0)
    assert estimate.low == pytest.approx(0.025 ** (1 / 192))
    mixed = proportion([(np.array([1.0, 0.0] * 50), 1)])
    assert mixed is not None
    assert mixed.low == pytest.approx(0.4, abs=0.03)


@pytest.mark.parametrize("estimate", ESTIMATES)
@settings(max_examples=25)
@given(sample=st.lists(st.integers(0, 1), min_size=1, max_size=20), copies=st.integers(2, 5))
def test_repeats_that_say_nothing_new_make_no_interval_narrower(
    estimate: Callable[..., Estimate | None], sample: list[int], copies: int
) -> None:
    values, labels = np.array(sample, dtype=float), list(range(len(sample)))
    alone = estimate([(values, 1)])
    repeated = estimate([(np.repeat(values, copies), 1)], [np.repeat(labels, copies)])
    assert alone is not None
    assert repeated is not None
    assert (repeated.value, repeated.low, repeated.high) == pytest.approx(
        (alone.value, alone.low, alone.high)
    )


def test_the_interval_of_clusters_is_that_of_their_means() -> None:
    random = np.random.default_rng(3)
    own, labels = random.normal(5.0, 1.0, 300), np.repeat(np.arange(300), 4)
    values = np.repeat(own, 4) + random.normal(0.0, 0.5, 1200)
    estimate = mean([(values, 1)], [labels])
    assert estimate is not None
    means = values.reshape(300, 4).mean(axis=1)
    error = 1.96 * means.std(ddof=1) / np.sqrt(300)
    assert estimate.value == pytest.approx(values.mean())
    assert estimate.high - estimate.low == pytest.approx(2 * error, rel=0.12)
    as_if_independent = mean([(values, 1)])
    assert as_if_independent is not None
    width = as_if_independent.high - as_if_independent.low
    assert width < 0.65 * (estimate.high - estimate.low)


def test_a_cluster_is_drawn_in_all_of_its_strata_at_once() -> None:
    values, labels = np.arange(30.0), list(range(30))
    strata = [(values, 2), (-values, 2)]
    together = mean(strata, [labels, labels])
    assert together == Estimate(0.0, 0.0, 0.0)
    apart = mean(strata, [labels, [f"other {label}" for label in labels]])
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
    strata = [
        (np.array([float(value)]), unit * number)
        for value, number in zip(values, times, strict=True)
    ]
    sample = resampling.sample_of(strata, [[label] for label in labels])
    counts = data.draw(
        st.lists(st.integers(0, 3), min_size=sample.clusters, max_size=sample.clusters).filter(any)
    )
    drawn = dict(zip(dict.fromkeys(labels), counts, strict=True))
    rows = zip(values, times, labels, strict=True)
    resample = [value for value, number, label in rows for _ in range(number * drawn[label])]
    weights = np.array([counts])
    assert resampling.medians(sample, weights) == pytest.approx([np.median(resample)])
    assert resampling.means(sample, weights) == pytest.approx([np.mean(resample)])


def test_the_exact_interval_counts_clusters() -> None:
    estimate = proportion([(np.ones(200), 1)], [np.repeat(np.arange(50), 4)])
    assert estimate is not None
    assert estimate.low == pytest.approx(0.025 ** (1 / 50))


def test_mcnemars_test_looks_at_the_pairs_that_differ() -> None:
    first = np.array([True] * 10 + [False] * 2 + [True] * 80 + [False] * 8)
    second = np.array([False] * 10 + [True] * 2 + [True] * 80 + [False] * 8)
    test = mcnemar(first, second)
    assert test is not None
    assert test.p == pytest.approx(0.03857, abs=1e-5)
    assert test.effect == pytest.approx(0.08)
    assert mcnemar(first, first) is None


@given(st.lists(st.integers(-9, 9), min_size=1, max_size=30))
def test_the_effect_is_favourable_ranks_less_unfavourable(values: list[int]) -> None:
    test = signed_rank(np.array(values, dtype=float))
    nonzero = [value for value in values if value]
    if not nonzero:
        assert test is None
        return
    assert test is not None
    sizes = sorted(abs(v) for v in nonzero)

    def rank(value: int) -> float:
        places = [i for i, size in enumerate(sizes, start=1) if size == abs(value)]
        return sum(places) / len(places)

    signed = sum(rank(value) * (1 if value > 0 else -1) for value in nonzero)
    assert test.effect == pytest.approx(signed / sum(range(1, len(nonzero) + 1)))
    assert 0.0 <= test.p <= 1.0


def test_a_rounded_value_may_lie_half_a_digit_outside() -> None:
    estimate = Estimate(1.0, 0.9, 1.1)
    assert estimate.covers(1.104, 0.005)
    assert not estimate.covers(1.106, 0.005)
    assert not estimate.covers(0.89, 0.005)


@settings(max_examples=40)
@given(st.lists(st.integers(-4, 4), min_size=1, max_size=15), st.integers(2, 5))
def test_repeats_that_say_nothing_new_make_no_test_surer(values: list[int], copies: int) -> None:
    own, labels = np.array(values, dtype=float), range(len(values))
    alone = signed_rank(own)
    repeated = signed_rank(np.repeat(own, copies), np.repeat(labels, copies))
    assert (alone is None) == (repeated is None)
    if alone is not None and repeated is not None:
        assert (repeated.p, repeated.effect) == pytest.approx((alone.p, alone.effect))
    first, second = own > 1, own < -1
    once = mcnemar(first, second)
    often = mcnemar(first.repeat(copies), second.repeat(copies), np.repeat(labels, copies))
    assert (once is None) == (often is None)
    if once is not None and often is not None:
        assert (often.p, often.effect) == pytest.approx((once.p, once.effect))


def test_what_goes_both_ways_in_each_cluster_is_no_difference_of_clusters() -> None:
    values, labels = np.array([1.0, -1.0] * 20), np.repeat(np.arange(20), 2)
    test = signed_rank(values, labels)
    assert test is not None
    assert (test.p, test.effect) == (1.0, 0.0)
    shares = mcnemar(values > 0, values < 0, labels)
    assert shares is not None
    assert (shares.p, shares.effect) == (1.0, 0.0)


@settings(max_examples=60)
@given(st.data())
def test_in_a_test_a_weight_is_as_so_many_copies(data: st.DataObject) -> None:
    rows = data.draw(
        st.lists(
            st.tuples(st.integers(-3, 3), st.integers(0, 4), st.integers(1, 4)),
            min_size=1,
            max_size=15,
        )
    )
    unit = data.draw(st.sampled_from([1.0, 0.1, 4 / 3]))
    values, labels, times = (np.array(column) for column in zip(*rows, strict=True))
    copies, own = np.repeat(values, times).astype(float), np.repeat(labels, times)
    weighed = signed_rank(values.astype(float), labels, unit * times)
    assert _numbers(weighed) == pytest.approx(_numbers(signed_rank(copies, own)))
    shares = mcnemar(values > 0, values < 0, labels, unit * times)
    assert _numbers(shares) == pytest.approx(_numbers(mcnemar(copies > 0, copies < 0, own)))


def _numbers(test: Test | None) -> tuple[float, ...]:
    return () if test is None else (test.p, test.effect)
