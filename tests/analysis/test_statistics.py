"""Tests and corrections against known values and plain definitions."""

from itertools import pairwise

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from testbed.analysis.statistics import Test, holm, mcnemar, signed_rank

pytestmark = pytest.mark.versions

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


@settings(max_examples=40)
@given(st.lists(st.integers(-4, 4).filter(bool), min_size=1, max_size=10), st.booleans())
def test_the_chance_of_few_differences_is_that_of_scipys_test(
    values: list[int], tied: bool
) -> None:
    own = np.array(values, dtype=float)
    if not tied:
        own *= 1 + np.arange(len(own)) / 100  # few are of one size
    test = signed_rank(own)
    assert test is not None
    assert test.p == pytest.approx(scipy.stats.wilcoxon(own).pvalue, abs=1e-12)


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
