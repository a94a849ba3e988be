"""Hostile lives: decisions of games in which something happens at every fourth step.

Whatever is achieved is undone, so that games last. How long decisions take, early and late, how
that grows with what has to be assumed, and whether the reference assumes the same.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from unittest.mock import patch

from asp.reasoning.diagnosis import incremental
from benchmarks.hostile_lives import EVERY, VARIANTS, Life, Moment, games, play
from benchmarks.measuring import median, quantile
from benchmarks.sheets import Row, Sheet, Value, gathered

GAMES = {"small": 1, "full": 100}
STEPS = {"small": 36, "full": 200}
COMPARED = {"small": 1, "full": 2}
WHOLE = {"small": (1, 36), "full": (3, 100)}
"""Games that are played with nothing compressed, and their steps: later ones take minutes."""
RELEVANCES = ("definition", "published")
HARDEST = "definition", "complete"
EARLY = 20
BIN = 5


def main(size: str) -> list[Sheet]:
    """Sheets `hostile` and `hidden`. Raises DisagreementError."""
    lives: dict[tuple[str, str], list[Life]] = {}
    kinds = product(RELEVANCES, VARIANTS)
    rows = gathered(_row(*kind, lives.setdefault(kind, []), size) for kind in kinds)
    with patch.object(incremental, "COMPRESSION", None):
        whole = [play(spec) for spec in games(*HARDEST, *WHOLE[size])]
    return [
        Sheet(
            "hostile",
            f"A decision in games of {STEPS[size]} steps, an event at every fourth of them",
            rows,
            (
                "process time, grounding included; early and late: medians of four decisions each,",
                f"up to step {EARLY} and to the last one; cut: the budget was used up; asked: new",
                "explanations that the reference was asked for, and answered within its budget",
            ),
        ),
        Sheet(
            "hidden",
            "A decision that explains anew, by how many events nobody told of it assumes",
            gathered(_growth(lives[HARDEST], whole)),
            ("whole: with nothing compressed",),
        ),
    ]


def _row(relevance: str, variant: str, lives: list[Life], size: str) -> Row:
    """Plays the games of a variant; their lives are added to the given ones."""
    steps = STEPS[size]
    specs = games(relevance, variant, GAMES[size], steps)
    lives += (play(spec) for spec in specs)
    compared = [play(spec, compares=True) for spec in specs[: COMPARED[size]]]
    moments = [moment for life in lives for moment in life.moments]
    took = [moment.ms for moment in moments]
    return {
        "relevance": relevance,
        "variant": variant,
        "games": len(lives),
        "decisions": len(took),
        "median_ms": median(took),
        "99_ms": quantile(took, 0.99),
        "worst_ms": max(took),
        "early_ms": _around(moments, EARLY),
        "late_ms": _around(moments, steps),
        "cut": sum(moment.cut for moment in moments),
        "most_assumed": max(moment.size for moment in moments),
        "asked": sum(life.asked for life in compared),
        "answered": sum(life.answered for life in compared),
    }


def _around(moments: Sequence[Moment], step: int) -> Value:
    """The median of as many decisions as there are from one event to the next."""
    took = [moment.ms for moment in moments if step - EVERY < moment.step <= step]
    return median(took) if took else None


def _growth(lives: Sequence[Life], whole: Sequence[Life]) -> Iterator[Row]:
    ours, theirs = _by_size(lives), _by_size(whole)
    for least in sorted(ours):
        took, other = ours[least], theirs.get(least, [])
        yield {
            "assumed_events": least,
            "measured": len(took),
            "median_ms": median(took),
            "99_ms": quantile(took, 0.99),
            "whole_measured": len(other),
            "whole_median_ms": median(other) if other else None,
        }


def _by_size(lives: Sequence[Life]) -> dict[int, list[float]]:
    """The times of decisions that adopted an explanation, in bins by its size."""
    found: dict[int, list[float]] = {}
    for moment in (moment for life in lives for moment in life.moments if moment.adopted):
        found.setdefault(moment.size // BIN * BIN, []).append(moment.ms - moment.grounding_ms)
    return found
