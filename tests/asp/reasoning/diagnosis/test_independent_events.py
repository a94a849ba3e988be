"""Histories of many events that do not depend on each other, more than are counted elsewhere."""

from collections.abc import Iterator
from dataclasses import replace
from random import Random

import pytest

from asp.language import Action, Literal
from asp.reasoning import Knowledge, knowledge
from asp.reasoning.diagnosis import (
    Compression,
    DiagnosisSessions,
    Explanation,
    Happening,
    History,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
    incremental,
)
from asp.reasoning.diagnosis.smallest_explanations import MANY

GOAL = (Literal.parse("lit(l0)"),)
SETTINGS = Compression(after=4)
LAMPS = """
sorts
  lamp = {%s}.
fluents
  inertial lit(lamp).
actions
  agent rest.
  exogenous flip(lamp).
laws
  flip(L) causes lit(L) if -lit(L).
  flip(L) causes -lit(L) if lit(L).
  rest causes lit(l0) if lit(l0).
"""


def _lamps(number: int) -> tuple[Knowledge, list[Literal]]:
    names = [f"l{place}" for place in range(number)]
    fluents = [Literal.of("lit", (name,)) for name in names]
    return knowledge("lamps", LAMPS % ", ".join(names)), fluents


def _flipped(fluents: list[Literal], steps: int, seen: float) -> Iterator[History]:
    """A growing history in which a lamp is flipped at every other step, each in its turn.

    Each lamp is seen with this probability, and each of them at first.
    """
    draw, on, history = Random(1), set[Literal](), History()
    history.observe((each.complement for each in fluents), 0)
    for step in range(steps):
        if step % 2 == 0:
            on ^= {fluents[step // 2 % len(fluents)]}
        history.step = step + 1
        looks = [each for each in fluents if draw.random() < seen]
        history.observe((each if each in on else each.complement for each in looks), history.step)
        yield history


def _diagnoser(
    domain: Knowledge, settings: Compression | None, monkeypatch: pytest.MonkeyPatch
) -> IncrementalDiagnoser[History]:
    monkeypatch.setattr(incremental, "COMPRESSION", settings)
    reference = ReferenceDiagnoser(domain, GOAL)
    return IncrementalDiagnoser(DiagnosisSessions(domain), GOAL, 0, reference)


@pytest.mark.parametrize("number", [9, MANY + 2])
def test_more_events_than_are_counted_are_compressed(
    number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each flip is seen at once, so that only the true flips explain what is seen."""
    domain, fluents = _lamps(number)
    diagnoser, adopted = _diagnoser(domain, SETTINGS, monkeypatch), Explanation()
    flips = MANY + 6
    for history in _flipped(fluents, 2 * flips, seen=1.0):
        adopted = diagnoser.diagnose(history, adopted).explanation
    true = (
        Happening(2 * place, Action.parse(f"flip(l{place % number})")) for place in range(flips)
    )
    assert adopted.unobserved == tuple(sorted(true))
    assert adopted.proved
    assert diagnoser.frontier is not None
    assert diagnoser.frontier.least(history) == (flips, 0)


@pytest.mark.parametrize("arcs", [2, SETTINGS.arcs])
def test_what_is_seen_of_some_is_explained_as_in_the_whole_history(
    arcs: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    domain, fluents = _lamps(MANY + 1)
    ours = _diagnoser(domain, replace(SETTINGS, arcs=arcs), monkeypatch)
    whole = _diagnoser(domain, None, monkeypatch)
    adopted = Explanation()
    for history in _flipped(fluents, 18, seen=0.9):
        theirs = whole.diagnose(history, adopted).explanation
        adopted = ours.diagnose(history, adopted).explanation
        assert adopted == theirs, history.step


def test_more_than_a_hundred_possible_states_are_compressed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Seven lamps are never seen, so that any of them may be lit: there are 128 states."""
    domain, fluents = _lamps(8)
    diagnoser, adopted = _diagnoser(domain, SETTINGS, monkeypatch), Explanation()
    history, seen = History(), fluents[0]
    history.observe((each.complement for each in fluents), 0)
    for history.step in range(1, 14):
        history.observe([seen if history.step % 2 else seen.complement], history.step)
        adopted = diagnoser.diagnose(history, adopted).explanation
    assert adopted.proved
    assert adopted.size == history.step
    assert diagnoser.frontier is not None
    assert diagnoser.frontier.least(history) == (history.step, 0)
