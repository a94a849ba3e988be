"""A compressed history gives the answers that the whole one gives, case by case."""

import copy
import gc
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asp.language import Literal
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import SELECT, Compression, DiagnosisSessions, History
from asp.reasoning.diagnosis.long_histories import arcs
from asp.reasoning.diagnosis.long_histories.frontier import Frontier
from asp.reasoning.diagnosis.long_histories.paths import Path
from asp.reasoning.diagnosis.smallest_explanations import Interpretation
from tests.agents.intentional.lives import OFFICE, place
from tests.asp.reasoning.diagnosis.minds import TINY, WHOLE, Mind, compare, compare_others
from tests.asp.reasoning.diagnosis.wandering import Habits, wander
from tests.literals import parsed

LOCK = Literal.parse("exo_lock(library)")

USUAL = Compression()
GOAL = parsed(["loc(book1,library)", "-in_hand(rob1,book1)"])
PLACES = {
    "office": OFFICE,
    "library": place("library"),
    "dark office": place("office", dark=True),
    "dark library": place("library", dark=True),
}


@pytest.mark.parametrize("name", sorted(PLACES))
@settings(max_examples=4)
@given(
    seed=st.integers(0, 10**6),
    event=st.sampled_from([0.05, 0.15]),
    reported=st.sampled_from([0.0, 0.5, 1.0]),
    false_report=st.sampled_from([0.0, 0.1]),
    looks=st.sampled_from([0.3, 1.0]),
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
    kept: int,
    most: int,
) -> None:
    habits = Habits(event=event, reported=reported, false_report=false_report, looks=looks)
    compression = replace(TINY, kept=kept, most=most)
    compare(PLACES[name], GOAL, 24, seed, habits, compression)


LIVELY = Habits(event=0.1, false_report=0.05, looks=0.9)
QUIET = Habits(event=0.04, reported=0.3, false_report=0.0, late=0, looks=0.5)
TOLD = Habits(event=0.1, reported=1.0, false_report=0.0, late=0, looks=0.5)
LATE = Habits(event=0.1, reported=0.9, false_report=0.0, late=12, looks=0.5)


@pytest.mark.parametrize(
    ("name", "steps", "seed", "habits", "compression"),
    [
        pytest.param("office", 80, 11, QUIET, USUAL, id="as robots do it"),
        pytest.param("library", 60, 12, QUIET, USUAL, id="in another domain"),
        pytest.param("office", 40, 13, LIVELY, TINY, id="many events"),
        pytest.param("office", 50, 14, LATE, TINY, id="news of what was compressed"),
        pytest.param(
            "office", 40, 15, LIVELY, replace(TINY, answers=20), id="hardly time to compress"
        ),
        pytest.param("library", 30, 16, LIVELY, replace(TINY, most=3), id="hardly room for states"),
    ],
)
def test_long_histories(
    name: str, steps: int, seed: int, habits: Habits, compression: Compression
) -> None:
    assert compare(PLACES[name], GOAL, steps, seed, habits, compression) > 0


def test_a_long_history_is_explained_by_what_is_compressed(monkeypatch: pytest.MonkeyPatch) -> None:
    smallest, found = Frontier.smallest, list[bool]()

    def counted(known: Frontier, history: History) -> Interpretation | None:
        interpretation = smallest(known, history)
        found.append(interpretation is not None)
        return interpretation

    monkeypatch.setattr(Frontier, "smallest", counted)
    assert compare(OFFICE, GOAL, 40, 13, LIVELY, TINY) > 0
    assert any(found)


def _sees(history: History, *literals: str) -> None:
    history.step += 1
    history.observe(parsed(literals), history.step)


def test_what_could_only_happen_in_the_compressed_past() -> None:
    """The library is locked early on, and for all its life the robot sees that it stays so.

    At last it learns that a book is not in there: it was taken away while the door was open.
    """
    known = parsed(["loc(book1,library)", "loc(book2,kitchen)", "loc(rob1,kitchen)"])
    minds = Mind(OFFICE, USUAL, GOAL), Mind(OFFICE, WHOLE, GOAL)
    histories = History(), History()
    for mind, history in zip(minds, histories, strict=True):
        history.observe(OFFICE.world.literals(OFFICE.world.state(known)), 0)
        history.happened(SELECT, True, 0)
        for step in range(60):
            if step == 5:
                history.happened(LOCK, True, 5)
            _sees(history, "locked(library)" if step >= 5 else "-locked(library)")
            mind.think(history)
        _sees(history, "-loc(book1,library)")
        mind.think(history)
    compressed, whole = minds
    assert compressed.compressed > 6
    assert [(e.step, e.action) for e in compressed.adopted.unobserved] == [
        (5, "exo_move(book1,kitchen)")
    ]
    assert compressed.adopted == whole.adopted
    assert compressed.diagnoser.belief == whole.diagnoser.belief
    compare_others(compressed.others, whole.others, whole.adopted)


def test_news_of_the_selection_of_the_goal_stays_false_in_the_compressed_past() -> None:
    """Nothing else happens at step 0, so that the library was locked at another one."""
    known = parsed(["loc(book1,library)", "loc(book2,kitchen)", "loc(rob1,office1)"])
    minds = Mind(OFFICE, TINY, GOAL), Mind(OFFICE, WHOLE, GOAL)
    for mind in minds:
        history = History()
        history.observe(OFFICE.world.literals(OFFICE.world.state(known)), 0)
        history.happened(SELECT, True, 0)
        for step in range(20):
            if step == 8:
                history.happened(LOCK, True, 0)
            _sees(history, "loc(rob1,office1)")
            mind.think(history)
        _sees(history, "locked(library)")
        mind.think(history)
        assert [(e.step, e.action) for e in mind.adopted.distrusted] == [(0, LOCK)]
        assert [e.action for e in mind.adopted.unobserved] == [LOCK]
    compressed, whole = minds
    assert compressed.compressed > 6
    assert compressed.adopted == whole.adopted
    assert compressed.diagnoser.belief == whole.diagnoser.belief


def test_what_is_forgotten_of_transitions_is_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(arcs, "REMEMBERED", 3)
    few = DiagnosisSessions(knowledge(OFFICE.domain, OFFICE.source))
    forgetful, whole = Mind(OFFICE, TINY, GOAL, few), Mind(OFFICE, WHOLE, GOAL)
    for history in wander(OFFICE, GOAL, 30, 13, LIVELY):
        assert forgetful.think(copy.deepcopy(history)) == whole.think(history), history.step
    assert forgetful.compressed > 20


def test_a_life_of_a_thousand_steps_keeps_little() -> None:
    """What is kept of the compressed past has a bound."""
    mind = Mind(OFFICE, USUAL, GOAL)
    for history in wander(OFFICE, GOAL, 1_000, 17, TOLD):
        mind.think(history)
    assert mind.compressed > 900
    gc.collect()
    whole, recent = 1_000, USUAL.late * USUAL.most
    assert sum(isinstance(each, Path) for each in gc.get_objects()) < whole + recent
