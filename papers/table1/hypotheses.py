"""What could make the published rows 3 and 5: each hypothesis with what would come of it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from papers.table1 import evidence
from papers.table1.pairs import Pair
from papers.table1.released import NAMES, PAIRS
from papers.table1.weighing import Weighing, weighing
from papers.text import percent, render
from testbed.analysis.bootstrap import Estimate
from testbed.studies.table1.measures import RANDOM
from testbed.studies.table1.published import PUBLISHED, SCENARIOS
from testbed.text import number

AS_PLAYED, PASSED_ON = "as played", "released draw"
Weights = Callable[[Pair], float]


@dataclass(frozen=True)
class Hypothesis:
    """What would have been otherwise, and the table that comes of it."""

    name: str
    weighed: Weighing


def hypotheses(
    pairs: Sequence[Pair], goal: Sequence[str], released: Mapping[str, float]
) -> list[Hypothesis]:
    """Those that only ask how often what was played would have happened.

    `released` has the weights of pairs under the released simulator's draw, by the intentional
    robot's trial; nothing where they are not known.
    """
    ways: dict[str, Weights] = {
        AS_PLAYED: lambda _: 1.0,
        **_redrawn(released),
        "starts: something in hand": lambda pair: float(_undone(pair, goal, "-")),
        "starts: nothing in hand": lambda pair: float(not _undone(pair, goal, "-")),
        "starts: nothing in place": lambda pair: float(not _in_place(pair, goal)),
        "starts: something in place": lambda pair: float(_in_place(pair, goal)),
        "event beside the first action": lambda pair: float(len(pair.treatment.before) == 1),
        "event beside a later action": lambda pair: float(len(pair.treatment.before) > 1),
    }
    return [Hypothesis(name, weigh(pairs, weights)) for name, weights in ways.items()]


def weigh(pairs: Sequence[Pair], weights: Weights) -> Weighing:
    """The table of the random ones among some pairs."""
    drawn = [pair for pair in pairs if pair.intended == RANDOM]
    return weighing(drawn, [weights(pair) for pair in drawn])


def both(name: str, pairs: Sequence[Pair], released: Mapping[str, float]) -> tuple[Hypothesis, ...]:
    """What was otherwise in a run of its own, under either draw where there are weights."""
    plain = Hypothesis(name, weigh(pairs, lambda _: 1.0))
    ways = _redrawn(released).items()
    return plain, *(Hypothesis(f"{name}; {way}", weigh(pairs, own)) for way, own in ways)


def _redrawn(released: Mapping[str, float]) -> dict[str, Weights]:
    return {PASSED_ON: lambda pair: released[pair.treatment.trial]} if released else {}


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
        near=evidence.closeness(best.weighed.table),
        left=list(evidence.outside(best.weighed.table.rows)),
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
    rows = {row.name: row for row in own.weighed.table.rows}
    near = evidence.closeness(own.weighed.table)
    return (
        own.name,
        *(_value(rows[name].baseline, percent) for name in ("3", "4")),
        _value(rows["2"].ratios["plans"].mean, number),
        _value(rows["5"].ratios["execution_units"].mean, number),
        _value(rows["5"].ratios["actions"].mean, number),
        _shares(own.weighed.shares),
        f"{near.inside} of {near.values}",
        percent(near.distance),
    )


def _value(own: Estimate | None, written: Callable[[float], str]) -> str:
    return "-" if own is None else written(own.value)


def _shares(shares: Mapping[str, float]) -> str:
    return " ".join(f"{100 * shares[name]:.0f}" for name in SCENARIOS) + "%"


def _agreement(own: Hypothesis) -> tuple[int, float]:
    """More values inside are better, and of equally many the smaller distance."""
    near = evidence.closeness(own.weighed.table)
    return near.inside, -near.distance
