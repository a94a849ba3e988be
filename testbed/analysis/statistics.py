"""Paired tests, effect sizes, and Holm's correction of p-values."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy  # type: ignore[import-untyped]  # its parts load when they are used
from numpy.typing import NDArray

from testbed.analysis.bootstrap import Labels, Values, numbered

MOST_EXACT = 13
"""Differences of which every choice of signs is looked at."""
DIGITS = 12
"""Decimals of a mean of differences: what comes behind them is rounding."""


@dataclass(frozen=True)
class Test:
    """A paired test: how likely such a difference is by chance, and how large it is.

    `effect` lies between -1 and 1 and is above 0 where the first of the two has more; `holm` is the
    p-value after Holm's correction, None before it.
    """

    __test__ = False

    p: float
    effect: float
    holm: float | None = None


def signed_rank(
    differences: Values, clusters: Labels | None = None, weights: Values | None = None
) -> Test | None:
    """Wilcoxon's signed-rank test, with the matched-pairs rank-biserial correlation.

    Pairs without a difference are left out; None where there is no other. With labels both are of
    the clusters' mean differences, which are independent; in these means the weights count.
    """
    if not differences.any():
        return None
    tested = cluster_means(differences, clusters, weights)
    nonzero = tested[tested != 0]
    if not len(nonzero):
        return Test(1.0, 0.0)
    ranks = scipy.stats.rankdata(np.abs(nonzero))
    effect = float(ranks @ np.sign(nonzero) / ranks.sum())
    return Test(_chance_of(nonzero, ranks), effect)


def _chance_of(differences: Values, ranks: Values) -> float:
    """The p-value of the ranks of differences: exact of few, as `scipy.stats.wilcoxon` has it.

    Where some are of one size it goes through all signs one by one; here they are one product.
    """
    if not 1 < len(differences) <= MOST_EXACT:
        return float(scipy.stats.wilcoxon(differences).pvalue)
    found = scipy.stats.permutation_test(
        (differences,),
        lambda signed, axis: np.moveaxis(np.sign(signed), axis, -1) @ ranks,
        permutation_type="samples",
        vectorized=True,
    )
    return float(found.pvalue)


def mcnemar(
    first: NDArray[np.bool_],
    second: NDArray[np.bool_],
    clusters: Labels | None = None,
    weights: Values | None = None,
) -> Test | None:
    """McNemar's exact test of paired outcomes; the effect is the difference of the proportions.

    None where no pair differs. With labels the test counts the clusters in which one of the two is
    right more often than the other, by weight where there are weights.
    """
    differences = first.astype(float) - second.astype(float)
    if not differences.any():
        return None
    tested = cluster_means(differences, clusters, weights)
    only_first, only_second = int((tested > 0).sum()), int((tested < 0).sum())
    number = only_first + only_second
    p = float(scipy.stats.binomtest(only_first, number).pvalue) if number else 1.0
    return Test(p, float(np.average(differences, weights=weights)))


def cluster_means(values: Values, clusters: Labels | None, weights: Values | None = None) -> Values:
    """The mean of each cluster, weighted if there are weights; without labels the values."""
    if clusters is None:
        return values
    cluster = numbered(clusters)
    own = np.ones(len(values)) if weights is None else weights
    means: Values = np.bincount(cluster, own * values) / np.bincount(cluster, own)
    return np.round(means, DIGITS)


def holm(p_values: Sequence[float]) -> list[float]:
    """The p-values after Holm's step-down correction, in the order given."""
    corrected, running = [0.0] * len(p_values), 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
        running = max(running, min(1.0, (len(p_values) - rank) * p_values[index]))
        corrected[index] = running
    return corrected
