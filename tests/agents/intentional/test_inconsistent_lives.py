"""Conflicts beside an oracle that follows all states a little world can be in."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import chain, combinations

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from asp.language import Action, Literal
from asp.reasoning import goal_facts, knowledge
from asp.reasoning.diagnosis import (
    GOAL,
    SELECT,
    Explanation,
    InconsistentHistoryError,
    cannot_hold,
    conflict,
)
from tests.agents.intentional.test_joint_lives import ONE_BOOK, WORLD
from tests.literals import parsed

OFFICE = knowledge("office", ONE_BOOK)
ROBOT = WORLD.description.robots[0]
WANTED = parsed(["loc(book1,library)"])
STEPS = 3
STATES = list(WORLD.initial_states())


@dataclass(frozen=True)
class Statement:
    """obs(LITERAL) or hpd(LITERAL) at a step; of a result the literal is the attempted action."""

    kind: str
    literal: Literal
    step: int

    def __str__(self) -> str:
        return f"{self.kind}({self.literal}) at {self.step}"

    @property
    def reversed(self) -> Statement:
        return Statement(self.kind, self.literal.complement, self.step)


@dataclass(frozen=True)
class Account:
    """What a robot that knew only what it saw did, and what it says of it."""

    attempts: tuple[Action, ...]
    statements: tuple[Statement, ...]

    def history(self) -> History:
        history = History(step=STEPS)
        history.happened(SELECT, True, 0)
        for step, action in enumerate(self.attempts, start=1):
            history.attempt(action, step)
        for said in self.statements:
            if said.kind == "obs":
                history.observe([said.literal], said.step)
            else:
                history.happened(said.literal.atom, said.literal.is_positive, said.step)
        return history

    def can_hold(self, statements: Collection[Statement]) -> bool:
        """Whether some initial state and some events at steps 1, 2, ... make these true."""
        states = frozenset(STATES)
        for step in range(STEPS + 1):
            at = [said for said in statements if said.step == step]
            states = frozenset(state for state in states if _agrees(state, at))
            if step < STEPS:
                attempt = self.attempts[step - 1] if step else None
                results = {said.literal.is_positive for said in at if said.kind == "hpd"}
                states = frozenset[int]().union(
                    *(
                        _after(state, attempt)
                        for state in states
                        if all(told == _succeeds(state, attempt) for told in results)
                    )
                )
        return bool(states)


def _agrees(state: int, statements: Collection[Statement]) -> bool:
    return all(
        WORLD.satisfies(state, WANTED) == said.literal.is_positive
        if said.literal.atom == GOAL
        else WORLD.holds(state, said.literal)
        for said in statements
        if said.kind == "obs"
    )


def _succeeds(state: int, attempt: str | None) -> bool:
    return attempt is not None and WORLD.executable(state, [attempt])


@cache
def _after(state: int, attempt: str | None) -> frozenset[int]:
    """What may come of an attempt, or of the selection of the goal, at which nothing happens."""
    if attempt is None:
        return frozenset({state})
    own = [attempt] if _succeeds(state, attempt) else []
    events = [event for event in WORLD.exogenous_actions if WORLD.executable(state, [*own, event])]
    some = chain.from_iterable(combinations(events, n) for n in range(len(events) + 1))
    together = ({*own, *events} for events in some)
    return frozenset(
        WORLD.successor(state, actions) for actions in together if WORLD.executable(state, actions)
    )


@st.composite
def accounts(draw: st.DrawFn) -> Account:
    """A true account, of which some statements are turned round."""
    attempts = tuple(draw(st.sampled_from(WORLD.agent_actions)) for _ in range(1, STEPS))
    state = draw(st.sampled_from(STATES))
    said = [Statement("obs", literal, 0) for literal in WORLD.visible(state, ROBOT)]
    for step in range(STEPS):
        attempt = attempts[step - 1] if step else None
        if attempt is not None:
            told_of = attempt if _succeeds(state, attempt) else attempt.complement
            said.append(Statement("hpd", told_of, step))
        state = draw(st.sampled_from(sorted(_after(state, attempt))))
        said += [Statement("obs", one, step + 1) for one in WORLD.visible(state, ROBOT)]
    holds = WORLD.satisfies(state, WANTED)
    said.append(Statement("obs", GOAL if holds else GOAL.complement, STEPS))
    false = draw(st.sets(st.integers(0, len(said) - 1), min_size=1, max_size=4))
    told = (one.reversed if number in false else one for number, one in enumerate(said))
    return Account(attempts, tuple(told))


def _found(account: Account) -> Iterator[Statement] | None:
    facts = [*OFFICE.start, *account.history().facts(), *goal_facts(WANTED)]
    texts = conflict(OFFICE.program, facts, STEPS)
    by_text = {str(said): said for said in account.statements}
    return None if texts is None else (by_text[text] for text in texts)


careful = settings(max_examples=60)


@careful
@given(account=accounts())
def test_what_is_named_cannot_hold_and_whatever_is_left_out_the_rest_can(account: Account) -> None:
    found = _found(account)
    if found is None:
        assert account.can_hold(account.statements)
        return
    named = set(found)
    assert not account.can_hold(named)
    assert all(account.can_hold(named - {said}) for said in named)


@pytest.mark.parametrize("make", [ReferenceReasoner, IncrementalReasoner])
@settings(careful, max_examples=20)
@given(account=accounts())
def test_robots_stop_where_there_is_a_conflict_whatever_defaults_say(
    make: type[ReferenceReasoner], account: Account
) -> None:
    found = _found(account)
    assume(found is not None)
    with pytest.raises(InconsistentHistoryError) as error:
        make(OFFICE, WANTED, 3).diagnose(account.history(), Explanation())
    assert found is not None
    assert str(error.value) == f"inconsistent history: {cannot_hold(tuple(map(str, found)))}"
