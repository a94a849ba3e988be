"""Pairs made by hand, from which the numbers of a page can be worked out on paper."""

from testbed.analysis.comparison import TIMES
from testbed.studies.table1.load import Pair, Side
from testbed.studies.table1.published import MEASURES


def a_side(correct: bool = True, **values: object) -> Side:
    """One robot's trial: every measure 1, an event beside the first action, unless given.

    `plans`, `actions` and other measures are given by their names.
    """
    names = (*MEASURES, *TIMES)
    measures = dict.fromkeys(names, 1.0)
    measures.update(
        {name: float(str(values.pop(name))) for name in dict.fromkeys(names) if name in values}
    )
    given: dict[str, object] = {
        "trial": "t",
        "lost": False,
        "achieved": correct,
        "correct": correct,
        "out_of_reach": False,
        "outcome": "achieved" if correct else "false_finish",
        "event": "exo_move(book1,kitchen)",
        "undone": False,
        "before": ("move(rob1,kitchen)",),
        "measures": measures,
    }
    return Side(**(given | values))  # type: ignore[arg-type]


def a_pair(
    happened: str,
    mind: Side | None = None,
    base: Side | None = None,
    intended: str = "random",
    state: str = "s",
) -> Pair:
    """A pair that came to be a scenario; drawn at random unless another one was intended."""
    return Pair(intended, happened, True, mind or a_side(), base or a_side(), state, {})
