"""Hostile lives: decisions of games in which something happens at every fourth step.

Whatever is achieved is undone, so that games last. How long decisions take, early and late, how
that grows with what has to be assumed, and whether the reference explains the same.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

from asp.reasoning.diagnosis import incremental
from benchmarks.besieger import EVERY
from benchmarks.hostile_lives import GIVEN_UP, REFERENCE, Life, Moment, play, verdicts
from benchmarks.hostile_settings import VARIANTS, Kind, games
from benchmarks.measuring import median, quantile
from benchmarks.sheets import DisagreementError, Row, Sheet, Value, gathered

GAMES = {"small": 1, "full": 100}
STEPS = {"small": 36, "full": 200}
WHOLE = {"small": (1, 24), "full": (3, 100)}
"""Games that are played with nothing compressed, and their steps: later ones take minutes."""
HARDEST = Kind("office", "definition", "complete")
KINDS = (
    *(Kind("office", *each) for each in product(("definition", "published"), VARIANTS)),
    Kind("three books", "definition", "complete"),
    Kind("coast", "definition", "complete"),
)
EARLY = 20
BIN = 5
ASKED, ASKED_LONGER, LONGER = 24, 64, 3
"""The last step at which the reference is asked, and that of the first games of a row, so many of
them: it grounds each history from scratch, which takes ever longer."""


def main(size: str) -> list[Sheet]:
    """Sheets `hostile` and `hidden`. Raises DisagreementError."""
    hardest: list[Life] = []
    with TemporaryDirectory() as name:
        folder = Path(name)
        rows = gathered(_rows(size, folder, hardest))
        with patch.object(incremental, "COMPRESSION", None):
            whole = [play(spec) for spec in games(HARDEST, *WHOLE[size], folder)]
    return [
        Sheet(
            "hostile",
            f"A decision in games of {STEPS[size]} steps, an event at every fourth of them",
            rows,
            (
                "process time, grounding included; early and late: medians of four decisions each,",
                f"up to step {EARLY} and to the last one; cut: the budget was used up; asked: what",
                f"was explained anew up to step {ASKED}, in {LONGER} games up to {ASKED_LONGER},",
                f"until the reference did not end {GIVEN_UP} times within {REFERENCE.conflicts:,}",
                "conflicts; ended: it proved its answer; equal: ours is the same",
            ),
        ),
        Sheet(
            "hidden",
            "A decision that explains anew, by how many events nobody told of it assumes",
            gathered(_growth(hardest, whole)),
            ("whole: with nothing compressed",),
        ),
    ]


def _rows(size: str, folder: Path, hardest: list[Life]) -> Iterator[Row]:
    """A row per kind of games; the lives of the hardest kind are added to the given ones."""
    for kind in KINDS:
        specs = games(kind, GAMES[size], STEPS[size], folder)
        lives = [play(spec, ASKED_LONGER) for spec in specs[:LONGER]]
        lives += (play(spec, ASKED) for spec in specs[LONGER:])
        asked = [verdict for life in lives for verdict in verdicts(life)]
        yield {
            "setting": kind.setting,
            "relevance": kind.relevance,
            "variant": kind.variant,
            **_times(lives, STEPS[size]),
            "asked": len(asked),
            "ended": sum(verdict.ended for verdict in asked),
            "equal": sum(verdict.equal for verdict in asked),
        }
        if any(verdict.ended and not verdict.equal for verdict in asked):
            raise DisagreementError(f"the reference explains something in {kind} otherwise")
        if kind == HARDEST:
            hardest += lives


def _times(lives: Sequence[Life], steps: int) -> Row:
    moments = [moment for life in lives for moment in life.moments]
    took = [moment.ms for moment in moments]
    return {
        "games": len(lives),
        "decisions": len(took),
        "median_ms": median(took),
        "99_ms": quantile(took, 0.99),
        "worst_ms": max(took),
        "early_ms": _around(moments, EARLY),
        "late_ms": _around(moments, steps),
        "cut": sum(moment.cut for moment in moments),
        "most_assumed": max(moment.size for moment in moments),
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
