"""A folded past gives the answers that the whole history gives, case by case."""

from __future__ import annotations

import copy
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.shared.believing import Believer
from agents.shared.history import Diagnosis, History
from agents.shared.knowledge import Knowledge, knowledge
from agents.shared.memory import PACE
from asp.reasoning.diagnosis import Account, Assumed, Pace, Past, Windows
from asp.reasoning.diagnosis.long_histories import frontier
from asp.reasoning.diagnosis.long_histories.frontier import Frontier
from tests.agents.intentional.lives import OFFICE, Place, place
from tests.agents.shared.wandering import Habits, wander

UNFOLDED = Pace(after=1_000_000)
TINY = Pace(after=4, lag=3, margin=1, most=64, kept=3, work=400)
GOAL = ("loc(book1,library)", "-in_hand(rob1,book1)")
PLACES = {"office": OFFICE, "library": place("library")}


class Mind:
    """A believer, and what it has adopted."""

    def __init__(self, where: Place, pace: Pace) -> None:
        self.believer = Believer(_known(where), GOAL, 1, _unused, pace)
        self.adopted = Diagnosis()

    def think(self, history: History) -> tuple[object, ...]:
        """The explanation, whether it was held before, the state, when the goal held."""
        self.adopted, kept = self.believer.diagnose(history, self.adopted)
        belief = self.believer.belief
        return self.adopted, kept, belief.step, belief.state, belief.held

    def others(self, history: History) -> tuple[list[Assumed], bool]:
        return self.believer.alternatives(history, self.adopted, 20)


def _known(where: Place) -> Knowledge:
    return knowledge(where.domain, where.source)


def _unused(history: History, _adopted: Diagnosis) -> Diagnosis:
    raise AssertionError(f"more events than are counted at step {history.step}")


def compare(where: Place, steps: int, seed: int, habits: Habits, pace: Pace) -> int:
    """How often something was explained anew with a folded past, equal each time."""
    folded, whole = Mind(where, pace), Mind(where, UNFOLDED)
    explained = 0
    for history in wander(where, GOAL, steps, seed, habits):
        before = whole.adopted
        theirs = whole.think(copy.deepcopy(history))
        assert folded.think(history) == theirs, history.step
        if whole.adopted != before:
            explained += folded.believer.folded > 0
            _compare_others(folded.others(history), whole.others(history), whole.adopted)
    return explained


def _compare_others(
    folded: tuple[list[Assumed], bool], whole: tuple[list[Assumed], bool], adopted: Diagnosis
) -> None:
    """All explanations of the size are told, or that there are more."""
    (some, more), (every, too_many) = folded, whole
    assert len(set(some)) == len(some)
    assert all(a.size == adopted.size for a in some)
    if not too_many:
        assert set(some) <= set(every)
        assert more == (len(some) < len(every))


@pytest.mark.parametrize("name", sorted(PLACES))
@settings(max_examples=15)
@given(
    seed=st.integers(0, 10**6),
    event=st.sampled_from([0.05, 0.15]),
    reported=st.sampled_from([0.0, 0.5, 1.0]),
    false_report=st.sampled_from([0.0, 0.1]),
    looks=st.sampled_from([0.3, 1.0]),
    margin=st.integers(0, 2),
    kept=st.integers(1, 4),
    most=st.sampled_from([2, 10, 64]),
)
def test_short_histories(
    name: str,
    seed: int,
    event: float,
    reported: float,
    false_report: float,
    looks: float,
    margin: int,
    kept: int,
    most: int,
) -> None:
    habits = Habits(event=event, reported=reported, false_report=false_report, looks=looks)
    pace = replace(TINY, margin=margin, kept=kept, most=most)
    compare(PLACES[name], 24, seed, habits, pace)


LIVELY = Habits(event=0.1, false_report=0.05, looks=0.9)
QUIET = Habits(event=0.04, reported=0.3, false_report=0.0, late=0, looks=0.5)
TOLD = Habits(event=0.1, reported=1.0, false_report=0.0, late=0, looks=0.5)
LATE = Habits(event=0.1, reported=0.9, false_report=0.0, late=12, looks=0.5)


@pytest.mark.parametrize(
    ("name", "steps", "seed", "habits", "pace"),
    [
        pytest.param("office", 80, 11, QUIET, PACE, id="as robots do it"),
        pytest.param("library", 60, 12, QUIET, PACE, id="in another domain"),
        pytest.param("office", 40, 13, LIVELY, replace(TINY, margin=2), id="many events"),
        pytest.param("office", 50, 14, LATE, TINY, id="news of what was folded"),
        pytest.param("office", 40, 15, LIVELY, replace(TINY, work=20), id="hardly time to fold"),
        pytest.param("library", 30, 16, LIVELY, replace(TINY, most=3), id="hardly room for states"),
    ],
)
def test_long_histories(name: str, steps: int, seed: int, habits: Habits, pace: Pace) -> None:
    assert compare(PLACES[name], steps, seed, habits, pace) > 0


def test_the_end_of_a_history_is_explained_without_what_was_folded(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    smallest, found = Windows.smallest, list[bool]()

    def counted(windows: Windows, known: Frontier, past: Past, fewest: int) -> Account | None:
        account = smallest(windows, known, past, fewest)
        found.append(account is not None)
        return account

    monkeypatch.setattr(Windows, "smallest", counted)
    assert compare(OFFICE, 40, 13, LIVELY, replace(TINY, margin=2)) > 0
    assert any(found)


def _sees(history: History, *literals: str) -> None:
    history.step += 1
    history.observe(literals, history.step)


def test_what_could_only_happen_before_the_folded_past_ended() -> None:
    """The library is locked early on, and for all its life the robot sees that it stays so.

    At last it learns that a book is not in there: it was taken away while the door was open.
    """
    known = ("loc(book1,library)", "loc(book2,kitchen)", "loc(rob1,kitchen)")
    minds = Mind(OFFICE, PACE), Mind(OFFICE, UNFOLDED)
    histories = History(), History()
    for mind, history in zip(minds, histories, strict=True):
        history.observe(OFFICE.world.literals(OFFICE.world.state(known)), 0)
        history.happened("select(my_goal)", True, 0)
        for step in range(60):
            if step == 5:
                history.happened("exo_lock(library)", True, 5)
            _sees(history, "locked(library)" if step >= 5 else "-locked(library)")
            mind.think(history)
        _sees(history, "-loc(book1,library)")
        mind.think(history)
    folded, whole = minds
    assert folded.believer.folded > 6
    assert [(e.step, e.action) for e in folded.adopted.unobserved] == [
        (5, "exo_move(book1,kitchen)")
    ]
    assert folded.adopted == whole.adopted
    assert folded.believer.belief == whole.believer.belief
    _compare_others(folded.others(histories[0]), whole.others(histories[1]), whole.adopted)


def test_news_of_the_selection_of_the_goal_stays_false_in_the_folded_past() -> None:
    """Nothing else happens at step 0, so that the library was locked at another one."""
    known = ("loc(book1,library)", "loc(book2,kitchen)", "loc(rob1,office1)")
    minds = Mind(OFFICE, TINY), Mind(OFFICE, UNFOLDED)
    for mind in minds:
        history = History()
        history.observe(OFFICE.world.literals(OFFICE.world.state(known)), 0)
        history.happened("select(my_goal)", True, 0)
        for step in range(20):
            if step == 8:
                history.happened("exo_lock(library)", True, 0)
            _sees(history, "loc(rob1,office1)")
            mind.think(history)
        _sees(history, "locked(library)")
        mind.think(history)
        assert [(e.step, e.action) for e in mind.adopted.distrusted] == [(0, "exo_lock(library)")]
        assert [e.action for e in mind.adopted.unobserved] == ["exo_lock(library)"]
    folded, whole = minds
    assert folded.believer.folded > 6
    assert folded.adopted == whole.adopted
    assert folded.believer.belief == whole.believer.belief


def test_what_is_forgotten_of_transitions_is_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frontier, "REMEMBERED", 3)
    assert compare(OFFICE, 40, 13, LIVELY, TINY) > 0


def test_a_life_of_a_thousand_steps_keeps_little() -> None:
    """What is kept of the folded past, and of transitions, has a bound."""
    mind = Mind(OFFICE, PACE)
    sizes = []
    for history in wander(OFFICE, GOAL, 1_000, 17, TOLD):
        mind.think(history)
        sizes.append(mind.believer.kept)
    assert mind.believer.folded > 900
    assert max(sizes) <= frontier.REMEMBERED + PACE.most * (PACE.kept + 1)
