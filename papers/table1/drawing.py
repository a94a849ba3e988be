"""Which way of drawing what is exogenous explains the published table."""

from statistics import fmean

from papers.table1 import evidence
from papers.text import percent, render
from testbed.studies.table1.measures import Analysis
from testbed.studies.table1.pairs import UNCLASSIFIED
from testbed.studies.table1.published import ALL, PUBLISHED, SCENARIOS


def drawing(analysis: Analysis) -> str:
    """The weights of the published row of all, distances of both tables, changes of scenario."""
    weights, misfit = evidence.published_weights()
    ours = {name: evidence.shares(table) for name, table in analysis.tables.items()}
    near = {name: evidence.closeness(table) for name, table in analysis.tables.items()}
    kinds = sorted({kind for own in analysis.became.values() for kind in own})
    return render(
        "table1/drawing",
        scenarios=SCENARIOS,
        all=PUBLISHED[ALL],
        even_time=fmean(PUBLISHED[name].ratios["total_time"] for name in SCENARIOS),
        even_accuracy=fmean(PUBLISHED[name].baseline for name in SCENARIOS),
        misfit=misfit,
        weights=[
            (name, *(percent(own[scenario]) for scenario in SCENARIOS))
            for name, own in {"published, from its own rows": weights, **ours}.items()
        ],
        distances=[
            (name, f"{own.inside} of {own.values}", percent(own.distance))
            for name, own in near.items()
        ],
        kinds=tuple(kinds),
        became=[
            (name, *(str(own.get(kind, 0)) for kind in kinds))
            for name, own in analysis.became.items()
        ],
        unclassified=unclassified(analysis),
    )


def unclassified(analysis: Analysis) -> int:
    """How many pairs, of whatever was played, are of no scenario by the rules."""
    return sum(counts.get(UNCLASSIFIED, 0) for counts in analysis.became.values())
