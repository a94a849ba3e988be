"""What could make the published rows 3 and 5: each hypothesis with what would come of it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from papers.table1 import evidence
from papers.table1.pairs import Pair
from papers.table1.parts import Part, part_of
from papers.text import percent, render
from testbed.analysis.bootstrap import Estimate
from testbed.studies.table1.published import PUBLISHED, SCENARIOS
from testbed.text import number

AS_PLAYED = "as played"
NAMES = {"plans": "plans", "execution_units": "exec. time", "actions": "actions"}
"""The measures that do not depend on how fast a machine or a solver is."""
PAIRS = 800
"""About so many paired trials P 4 speaks of, in each of five scenarios."""


@dataclass(frozen=True)
class Hypothesis:
    """What would have been otherwise, and the table that comes of it."""

    name: str
    part: Part


def hypotheses(pairs: Sequence[Pair], goal: Sequence[str]) -> list[Hypothesis]:
    """Those that only ask how often what was played would have happened."""
    ways: dict[str, Callable[[Pair], bool]] = {
        AS_PLAYED: lambda _: True,
        "starts: something in hand": lambda pair: _undone(pair, goal, "-"),
        "starts: nothing in hand": lambda pair: not _undone(pair, goal, "-"),
        "starts: nothing in place": lambda pair: not _in_place(pair, goal),
        "starts: something in place": lambda pair: _in_place(pair, goal),
        "event beside the first action": lambda pair: len(pair.treatment.before) == 1,
        "event beside a later action": lambda pair: len(pair.treatment.before) > 1,
    }
    return [Hypothesis(name, part_of(filter(holds, pairs))) for name, holds in ways.items()]


def _in_place(pair: Pair, goal: Sequence[str]) -> bool:
    """Whether a part of the goal that asks for something to be true holds at the start."""
    return not set(goal).isdisjoint(pair.state.split())


def _undone(pair: Pair, goal: Sequence[str], sign: str) -> bool:
    """Whether what the goal wants to be false is true at the start."""
    unwanted = {literal.removeprefix(sign) for literal in goal if literal.startswith(sign)}
    return not unwanted.isdisjoint(pair.state.split())


def compared(found: Sequence[Hypothesis], with_variants: bool, with_told: bool) -> str:
    """All hypotheses beside each other, and which comes nearest: with the most values inside."""
    best = max(found, key=_agreement)
    weights, _ = evidence.published_weights()
    return render(
        "table1/hypotheses",
        with_variants=with_variants,
        with_told=with_told,
        rows=[_published_line(), *map(_line, found)],
        best=best.name,
        near=evidence.closeness(best.part.table),
        left=list(evidence.outside(best.part.table.rows)),
        names=NAMES,
        pairs=PAIRS,
        weights=weights,
    )


def _published_line() -> tuple[str, ...]:
    weights, _ = evidence.published_weights()
    five, two = PUBLISHED["5"].ratios, PUBLISHED["2"].ratios
    return (
        "published",
        percent(PUBLISHED["3"].baseline),
        percent(PUBLISHED["4"].baseline),
        number(two["plans"]),
        number(five["execution_units"]),
        number(five["actions"]),
        _shares(weights),
        "",
        "",
    )


def _line(own: Hypothesis) -> tuple[str, ...]:
    rows = {row.name: row for row in own.part.table.rows}
    near = evidence.closeness(own.part.table)
    return (
        own.name,
        *(_value(rows[name].baseline, percent) for name in ("3", "4")),
        _value(rows["2"].ratios["plans"].mean, number),
        _value(rows["5"].ratios["execution_units"].mean, number),
        _value(rows["5"].ratios["actions"].mean, number),
        _shares(own.part.shares),
        f"{near.inside} of {near.values}",
        percent(near.distance),
    )


def _value(own: Estimate | None, written: Callable[[float], str]) -> str:
    return "-" if own is None else written(own.value)


def _shares(shares: Mapping[str, float]) -> str:
    return " ".join(f"{100 * shares[name]:.0f}" for name in SCENARIOS) + "%"


def _agreement(own: Hypothesis) -> tuple[int, float]:
    """More values inside are better, and of equally many the smaller distance."""
    near = evidence.closeness(own.part.table)
    return near.inside, -near.distance
