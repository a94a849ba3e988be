"""Which way of drawing what is exogenous explains the published table."""

from __future__ import annotations

from papers.markdown import markdown, paragraph
from papers.table1 import evidence
from papers.text import percent
from testbed.studies.table1.classify import UNCLASSIFIED
from testbed.studies.table1.measures import Analysis
from testbed.studies.table1.published import ALL, PUBLISHED, SCENARIOS


def drawing(analysis: Analysis) -> str:
    """The weights of the published row of all, distances of both tables, and what became what."""
    weights, misfit = evidence.published_weights()
    return f"""\
## Which way of drawing explains the published table

{_averaged(misfit)}

{_weights(analysis, weights)}

How near each way comes in the rows 1 to 5, by plans, execution time, actions and TP's accuracy. The
distance is the mean of |ln(ours / published)| over the three ratios:

{_distances(analysis)}

What the pairs came to be, read off what ATI did:

{_became(analysis)}

No rule of classification fits in {unclassified(analysis)} of these pairs.
"""


def unclassified(analysis: Analysis) -> int:
    """How many pairs, of whatever was played, are of no scenario by the rules."""
    return sum(counts.get(UNCLASSIFIED, 0) for counts in analysis.became.values())


def _averaged(misfit: float) -> str:
    """Which average of the published rows the published row of all is."""
    row = PUBLISHED[ALL]
    return paragraph(
        "The published row `all` is not the average of the five rows with equal weights: that "
        f"would have a total time of {_even_time():.2f} in place of {row.ratios['total_time']:.2f},"
        f" and {_even_accuracy()} in place of {percent(row.baseline)}. With other weights, found "
        f"by least squares, no column of the average differs from it by more than {misfit:.3f}. "
        "Beside these weights the shares of the scenarios among our pairs (triggered, each is "
        "played equally often, and its event does not fire in all):"
    )


def _even_time() -> float:
    return sum(PUBLISHED[name].ratios["total_time"] for name in SCENARIOS) / len(SCENARIOS)


def _even_accuracy() -> str:
    return percent(sum(PUBLISHED[name].baseline for name in SCENARIOS) / len(SCENARIOS))


def _weights(analysis: Analysis, weights: dict[str, float]) -> str:
    rows = {"published, from its own rows": weights}
    if analysis.triggered is not None:
        rows["triggered"] = evidence.shares(analysis.triggered)
    if analysis.random is not None:
        rows["random"] = evidence.shares(analysis.random)
    return markdown(
        ("share of the pairs of 1 to 5", *SCENARIOS),
        [(name, *(percent(own[s]) for s in SCENARIOS)) for name, own in rows.items()],
    )


def _distances(analysis: Analysis) -> str:
    ways = {"triggered": analysis.triggered, "random": analysis.random}
    near = {name: evidence.closeness(own) for name, own in ways.items() if own is not None}
    return markdown(
        ("drawn", "published values inside our intervals", "distance of the ratios"),
        [(n, f"{c.inside} of {c.values}", percent(c.distance)) for n, c in near.items()],
    )


def _became(analysis: Analysis) -> str:
    kinds = sorted({kind for own in analysis.became.values() for kind in own})
    rows = analysis.became.items()
    return markdown(
        ("played as", *kinds),
        [(name, *(str(own.get(kind, 0)) for kind in kinds)) for name, own in rows],
    )
