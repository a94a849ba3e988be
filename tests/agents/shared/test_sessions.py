"""Controls of many domains: no more are kept than the bound, and what goes is gone at once."""

import gc
from typing import TypeVar
from weakref import ref

import pytest

from agents.intentional.checking import CheckingRobot, to_be_sure
from agents.shared import reasoning, sessions_of
from agents.shared.reasoning import Sessions
from asp.language import MOST_TEXTS, Description, parse_description
from asp.reasoning import knowledge
from asp.solving import Recent, Session
from testbed.protocol import Task
from tests.agents.intentional.lives import OFFICE, live
from tests.literals import parsed

T = TypeVar("T")

DOMAIN, SOURCE, WORLD = OFFICE.domain, OFFICE.source, OFFICE.world
INITIAL = WORLD.state(parsed(["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"]))
OUT_OF_REACH = parsed(["loc(book1,library)", "loc(book1,office1)"])
GOALS = (
    parsed(["loc(rob1,office2)"]),
    parsed(["loc(book1,library)"]),
    OUT_OF_REACH,
    parsed(["loc(rob1,library)"]),
)


@pytest.mark.usefixtures("uncollected")
def test_a_domain_that_is_not_kept_any_more_leaves_no_control(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(reasoning, "_SESSIONS", Recent(1))
    kept, controls = list[ref[Sessions]](), list[int]()
    for goal in (*GOALS, *GOALS):
        kept.append(_played(goal))
        controls.append(len(_alive(Session)))
    *gone, last = kept
    assert last() is not None
    assert [tools() for tools in gone] == [None] * len(gone)
    assert controls[: len(GOALS)] == controls[len(GOALS) :], "no more than each has by itself"


def test_of_many_texts_the_last_descriptions_are_remembered() -> None:
    for number in range(2 * MOST_TEXTS):
        text = SOURCE.replace("library", f"vault{number}")
        assert f"locked(vault{number})" in parse_description(text, "many.al").fluents
    gc.collect()
    vaults = [d for d in _alive(Description) if any("vault" in f for f in d.fluents)]
    assert 0 < len(vaults) <= MOST_TEXTS


def _played(goal: list[str]) -> ref[Sessions]:
    """The tools that a robot that checks had for its goal."""
    live(CheckingRobot(), INITIAL, goal, feedback=False)
    return ref(sessions_of(knowledge(DOMAIN, _source(goal))))


def _source(goal: list[str]) -> str:
    known = [*WORLD.literals(INITIAL)]
    task = Task(
        trial="t",
        robot="r",
        domain=DOMAIN,
        source=SOURCE,
        goal=goal,
        initial=known,
        plan_limit=9,
        seed=0,
    )
    return to_be_sure(task).source


def _alive(kind: type[T]) -> list[T]:
    return [found for found in gc.get_objects() if isinstance(found, kind)]
