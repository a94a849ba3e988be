"""A domain by itself: plans, explanations, transitions, asked in texts or in literals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import get_args

from asp.language import Action, DomainError, Literal, analyse, read_domain, unknown_atom
from asp.language import parse_description as parsed
from asp.reasoning import diagnosis
from asp.reasoning.diagnosis import Explanation
from asp.reasoning.knowledge import Knowledge
from asp.reasoning.planning import (
    IncrementalConformantPlanner,
    IncrementalPlanner,
    Plan,
    Plans,
    Reachability,
)
from asp.reasoning.successors import in_order
from asp.solving import State, answer_sets, ground, literal_of, state_of
from asp.translation import translate

MOST_STATES = 10_000
"""The largest diagram, in states."""
MOST_ACTIONS = 100
"""The longest plan that is looked for unless another limit is given."""

Given = Iterable[str]
"""Literals or actions: texts, or one text with commas between them."""
Key = tuple[str | int, ...]

_COMMA = re.compile(r",(?![^(]*\))")
_SHOWN = "next(F) :- holds(F,0). #show next/1."
_REACHED = """
holds(my_goal,I) :- step(I), holds(F,I) : goal(F,true); -holds(F,I) : goal(F,false).
-holds(my_goal,I) :- step(I), not holds(my_goal,I).
#defined goal/2.
"""


@dataclass(frozen=True)
class Step:
    """One step of a history.

    `observed` are literals of the state, `goal` whether the goal was seen to hold in it;
    `attempted` is the agent's action in that state, `took_effect` whether it was seen to, and
    `reported` are the exogenous actions that are said to have happened at the same time.
    """

    observed: Sequence[str] = ()
    attempted: str | None = None
    took_effect: bool = True
    reported: Sequence[str] = ()
    goal: bool | None = None


@dataclass(frozen=True)
class Diagram:
    """Every state of a domain, in the order of its fluents, and where single actions lead."""

    domain: Domain
    states: tuple[State, ...]

    @property
    def transitions(self) -> Iterator[tuple[State, Action, State]]:
        """Each transition, found when it is asked for, in the order of states and actions."""
        known = self.domain.description
        actions = (*known.agent_actions, *known.exogenous_actions)
        for before, action in product(self.states, actions):
            for after in self.domain.outcomes(before, frozenset([action])):
                yield before, action, after


def load(name_or_path: str) -> Domain:
    """The domain of a file, or a packaged one by its bare name (`office`), to be reasoned about.

    Raises SourceError for a mistake in the text and FileNotFoundError where there is no such file.
    """
    file, text = read_domain(name_or_path)
    return Domain(text, file)


class Domain:
    """The theory of one description. What is asked in texts is checked as it is parsed.

    A state is the frozen set of its true fluents. Of one that is given, what is left out is false
    unless it follows. Methods raise DomainError for a text, a state or a goal that the domain
    does not have, with one line that says why.
    """

    def __init__(self, text: str, file: str) -> None:
        """`text` is an AL_d text, `file` its name in errors. Raises SourceError."""
        self._source, self._signature = (text, file), analyse(text, file)[1]
        self.description = parsed(text, file)
        self._knowledge = Knowledge.of(self.description, translate(text, file))

    def state(self, given: Given) -> State:
        """The state with these literals; of fluents left out those are true that follow."""
        wanted, known = self._literals(given, "state"), self.description
        laws = [f"{law.head} :- {','.join(law.body)}." for law in known.constraints]
        laws += [f"-{fluent} :- not {fluent}." for fluent in known.fluents]
        inertial = frozenset(known.inertial)
        laws += [f"{'' if each.atom in inertial else ':- not '}{each}." for each in wanted]
        found, more = answer_sets(ground(laws, {}, ()), most=1)
        if len(found) == 1 and not more:
            return frozenset(literal_of(symbol) for symbol in found[0] if symbol.positive)
        core = None if found else diagnosis.never_together(self._knowledge.program, wanted)
        wrong = f"not one state has {', '.join(wanted) or 'nothing'} and what follows, and no more"
        raise DomainError(wrong if core is None else diagnosis.cannot_hold(core), "state")

    def plan(
        self, state: Given, goal: Given, limit: int = MOST_ACTIONS, plans: Plans = "optimistic"
    ) -> Plan | None:
        """The first shortest plan of the agent's actions in the order of declaration, or None.

        None says that no plan has at most `limit` actions. Where actions have several outcomes,
        some of them reach the goal; in a plan that is conformant, all do, and each action is
        possible in every state that may be reached by then. Raises DomainError, LimitError.
        """
        if plans not in get_args(Plans):
            raise DomainError(f"{plans!r} is none of: {', '.join(get_args(Plans))}", "plans")
        start, wanted = self.state(state), self._literals(goal, "goal")
        if not wanted:
            raise DomainError("should not be empty; a goal is literals such as f(a,b)", "goal")
        if all((each.atom in start) == each.is_positive for each in wanted):
            return ()
        planner, reachability = self._planning
        if reachability.reachable(start, wanted) is False:
            return None
        if plans == "optimistic":
            return planner.shortest(start, wanted, limit)
        actions, transitions = self.description.agent_actions, self._sessions.transitions
        conformant = IncrementalConformantPlanner(actions, transitions, planner)
        return conformant.shortest([start], wanted, limit)

    def successors(self, state: Given, actions: Given = ()) -> tuple[State, ...]:
        """The states that these actions, all at once, lead to; none where they cannot occur.

        There are several where the description is non-deterministic. Raises LimitError.
        """
        known = self._parsed(actions, ("actions",), "action", "agent", "exogenous")
        return self.outcomes(self.state(state), frozenset(known))

    def outcomes(self, state: State, actions: frozenset[Action]) -> tuple[State, ...]:
        """The same of a complete state and actions of the domain, which are not checked."""
        return self._sorted(self._sessions.transitions.outcomes(state, actions))

    def explain(self, history: Iterable[Step], goal: Given = ()) -> Explanation:
        """The smallest explanation of a history, the first of these in the stated order.

        It has the fewest unobserved events and distrusted reports, and then the fewest exceptions
        to defaults. Its `initial` leaves out what follows from the rest and from what was observed
        at step 0. Raises InconsistentHistoryError where nothing explains it, and LimitError.
        """
        told = self._history(history)
        found, known = self._diagnosis(told, goal).explanation, self._knowledge
        observed = diagnosis.record_of(told.at(0), known).observed
        return replace(found, initial=diagnosis.beyond_observed(known, observed, found.initial))

    def explanations(
        self, history: Iterable[Step], goal: Given = (), most: int = 100
    ) -> tuple[list[Explanation], bool]:
        """At most so many of the smallest explanations, and whether there are more.

        They differ in what happened; what they assume of the initial state is not listed. Raises as
        `explain` does.
        """
        alternatives = self._diagnosis(self._history(history), goal).alternatives
        assert alternatives is not None, "incremental diagnosis always has them"
        return alternatives(most)

    def diagram(self, most: int = MOST_STATES) -> Diagram:
        """The states, and their transitions by one action, which are found as they are asked for.

        Raises DomainError where there are more than `most` states, and LimitError.
        """
        control = ground([self._knowledge.program, _SHOWN], {"n": 0}, ())
        found, more = answer_sets(control, most=most)
        if more:
            raise DomainError(f"{self.description.name} has more than {most} states")
        return Diagram(self, self._sorted(map(state_of, found)))

    @cached_property
    def _sessions(self) -> diagnosis.DiagnosisSessions:
        return diagnosis.DiagnosisSessions(self._knowledge)

    @cached_property
    def _planning(self) -> tuple[IncrementalPlanner, Reachability]:
        planner = IncrementalPlanner(*self._source)
        return planner, Reachability(self.description, self._sessions.transitions, planner)

    def _literals(self, given: Given, *key: str | int) -> tuple[Literal, ...]:
        found = self._parsed(given, key, "fluent", "inertial", "defined")
        for literal in found:
            if literal.complement in found:
                raise DomainError(f"{literal.atom} contradicts {literal.atom.complement}", *key)
        return found

    def _parsed(self, given: Given, key: Key, what: str, *kinds: str) -> tuple[Literal, ...]:
        texts = _COMMA.split(
            "".join((given if isinstance(given, str) else ",".join(given)).split())
        )
        try:
            found = tuple(map(Literal.parse, filter(None, texts)))
        except ValueError as error:
            raise DomainError(f"{error} such as f(a,b)", *key) from None
        for each in found:
            asked = each.atom if what == "fluent" else each
            if unknown := unknown_atom(asked, self._signature, kinds, what):
                raise DomainError(unknown, *key)
        return found

    def _sorted(self, states: Iterable[State]) -> tuple[State, ...]:
        return tuple(in_order(states, self.description.fluents))

    def _diagnosis(self, history: diagnosis.History, goal: Given) -> diagnosis.Diagnosis:
        wanted, known = self._literals(goal, "goal"), self._knowledge
        with_goal = replace(known, program=known.program + _REACHED)
        reference = diagnosis.ReferenceDiagnoser[diagnosis.History](with_goal, wanted)
        diagnoser = diagnosis.IncrementalDiagnoser(self._sessions, wanted, 0, reference)
        return diagnoser.diagnose(history, Explanation())

    def _history(self, steps: Iterable[Step]) -> diagnosis.History:
        told = diagnosis.History()
        for time, step in enumerate(steps):
            key, moment = ("history", time), told.at(time)
            told.observe(self._literals(step.observed, *key, "observed"), time)
            if step.goal is not None:
                moment.observed[diagnosis.GOAL] = step.goal
            place, what = (*key, "attempted"), "action of the agent"
            moment.attempted += self._parsed(step.attempted or "", place, what, "agent")
            if len(moment.attempted) > 1:
                raise DomainError("one action at most is attempted at a step", *place)
            moment.happened |= dict.fromkeys(moment.attempted, step.took_effect)
            place, what = (*key, "reported"), "exogenous action"
            events = self._parsed(step.reported, place, what, "exogenous")
            moment.happened |= dict.fromkeys(events, True)
            told.step = time + bool(moment.happened)
        return told
