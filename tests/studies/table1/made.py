"""Pairs made by hand, from which the numbers of a page can be worked out on paper."""

from collections.abc import Collection, Iterable, Mapping

import polars as pl

from papers.table1.pairs import Pair, Side
from testbed.analysis.comparison import DIVIDED, LEAST
from testbed.analysis.pairs import OTHER, Compared
from testbed.studies.table1.measures import Analysis, analyse
from testbed.studies.table1.pairs import TOLD

ROBOTS = Compared("traditional", "intentional")


def a_side(correct: bool = True, **values: object) -> Side:
    """One robot's trial: every measure 1, an event beside the first action, unless given.

    `plans`, `actions` and other measures are given by their names.
    """
    measures = dict.fromkeys(DIVIDED, 1.0)
    measures.update({name: float(str(values.pop(name))) for name in DIVIDED if name in values})
    given: dict[str, object] = {
        "trial": "t",
        "achieved": correct,
        "correct": correct,
        "outcome": "achieved" if correct else "false_finish",
        "event": "exo_move(book1,kitchen)",
        "undone": False,
        "before": ("move(rob1,kitchen)",),
        "measures": measures,
    }
    return Side(**(given | values))  # type: ignore[arg-type]


def a_pair(
    happened: str,
    treatment: Side | None = None,
    baseline: Side | None = None,
    intended: str = "random",
    state: str = "s",
    apart: str | None = None,
) -> Pair:
    """A pair that came to be a scenario; drawn at random unless another one was intended."""
    sides = treatment or a_side(), baseline or a_side()
    return Pair(intended, happened, *sides, state, apart)


def frame_of(pairs: Iterable[Pair], least: Mapping[str, int | None]) -> pl.DataFrame:
    """The pairs as `pairs_in` has them; `least` are the measures of a shortest plan."""
    rows = [
        {
            "scenario": pair.intended,
            "happened": pair.happened,
            "state": pair.state,
            "apart": pair.apart,
            "meeting": pair.meeting,
            **{column: least.get(name) for name, column in LEAST.items()},
            **_columns(pair.baseline, "", pair.apart),
            **_columns(pair.treatment, OTHER, pair.apart),
        }
        for pair in pairs
    ]
    told = {name + who: kind for name, kind in TOLD.items() for who in ("", OTHER)}
    strings = dict.fromkeys(("happened", "apart", "meeting"), pl.String)
    known = dict.fromkeys(("correct", "correct" + OTHER), pl.Boolean)
    numbers = dict.fromkeys(LEAST.values(), pl.Int64)
    types = told | strings | known | numbers
    return pl.DataFrame(
        rows, schema_overrides={n: kind for n, kind in types.items() if n in rows[0]}
    )


def _columns(side: Side, who: str, apart: str | None) -> dict[str, object]:
    own = {
        "trial": side.trial,
        "achieved": side.achieved,
        "correct": side.correct if side.decided else None,
        "outcome": side.outcome,
        "ended": side.ended,
        "lost": apart == "lost",
        "out_of_reach": False,
        "event": side.event,
        "undone": side.undone,
        "before": list(side.before),
        **side.measures,
    }
    return {name + who: value for name, value in own.items()}


def analysed(
    pairs: Iterable[Pair],
    least: Mapping[str, int | None] | None = None,
    exhaustive: Collection[str] = (),
) -> Analysis:
    """What the study finds in the pairs."""
    return analyse(frame_of(pairs, least or {}), ROBOTS, exhaustive=exhaustive)
