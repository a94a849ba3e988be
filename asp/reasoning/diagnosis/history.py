"""Histories (D 2.3), and the contradictions in them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple, Self

from clingo import Symbol

from asp.language import Action, Fluent, Literal
from asp.reasoning.knowledge import Goal, Knowledge
from asp.solving import fact

GOAL = Literal.of("my_goal")
SELECT = Action.of("select", (GOAL,))


class Happening(NamedTuple):
    """An action at a step."""

    step: int
    action: Action


@dataclass
class Moment:
    """What a history says of one step.

    `observed` has the truth of fluents, `attempted` the agent's actions of any kind, `happened`
    whether an action, the agent's own or another's, took effect; `failing` are attempts whose
    execution failed though they may have been possible. Of the observed fluents the `doubtful` ones
    rest on tests, and the `misread` ones are taken for wrong.
    """

    observed: dict[Fluent, bool] = field(default_factory=dict)
    attempted: list[Action] = field(default_factory=list)
    happened: dict[Action, bool] = field(default_factory=dict)
    failing: list[Action] = field(default_factory=list)
    doubtful: frozenset[Fluent] = frozenset()
    misread: frozenset[Fluent] = frozenset()

    @property
    def trusted(self) -> dict[Fluent, bool]:
        """What was observed and is not taken for wrong."""
        return {f: truth for f, truth in self.observed.items() if f not in self.misread}

    def copy(self) -> Moment:
        """The same, to which something else may be added."""
        attempted, failing = [*self.attempted], [*self.failing]
        observed, happened = self.observed.copy(), self.happened.copy()
        return Moment(observed, attempted, happened, failing, self.doubtful, self.misread)


@dataclass
class History:
    """Statements obs, hpd, attempt, failing, doubtful and misread of all steps up to `step`.

    `late_news` are the steps of statements about earlier steps than the last one, as they came.
    """

    step: int = 0
    moments: dict[int, Moment] = field(default_factory=dict)
    late_news: list[int] = field(default_factory=list)

    def copy(self) -> Self:
        """The same, which may go on otherwise."""
        moments = {step: moment.copy() for step, moment in self.moments.items()}
        return replace(self, moments=moments, late_news=[*self.late_news])

    def at(self, step: int) -> Moment:
        """What is recorded of a step; made when it is first asked for."""
        return self.moments.setdefault(step, Moment())

    def observe(self, literals: Iterable[Literal], step: int) -> None:
        """obs(F,B,I) for each literal."""
        moment = self.at(step)
        for literal in literals:
            moment.observed[literal.atom] = literal.is_positive

    def doubt(self, literals: Iterable[Literal], step: int) -> None:
        """doubtful(F,I) for those of the literals that were observed."""
        moment = self.at(step)
        moment.doubtful |= moment.observed.keys() & {each.atom for each in literals}

    def distrust(self, wrong: Iterable[tuple[int, Fluent]]) -> None:
        """misread(F,I) for exactly these steps and fluents; it is news of the past."""
        pairs = frozenset(wrong)
        for step, moment in self.moments.items():
            misread = frozenset(fluent for time, fluent in pairs if time == step)
            if moment.misread != misread:
                self.late_news.append(step)
                moment.misread = misread

    @property
    def misread(self) -> tuple[Happening, ...]:
        """The observations that are taken for wrong, by step and fluent."""
        steps = sorted(self.moments.items())
        return tuple(Happening(step, f) for step, m in steps for f in sorted(m.misread))

    @property
    def has_doubts(self) -> bool:
        """Whether any observation rests on tests."""
        return any(moment.doubtful for moment in self.moments.values())

    def happened(self, action: Action, truth: bool, step: int) -> None:
        """hpd(A,B,I)."""
        if step < self.step:
            self.late_news.append(step)
        self.at(step).happened[action] = truth

    def attempt(self, action: Action, step: int) -> None:
        """attempt(A,I)."""
        self.at(step).attempted.append(action)

    def failed(self, action: Action, step: int) -> None:
        """failing(A,I)."""
        self.at(step).failing.append(action)

    def facts(self) -> Iterator[Symbol]:
        """The history as facts for the theory, step by step."""
        for step, moment in self.moments.items():
            yield from (fact("obs", f, _boolean(b), step) for f, b in moment.observed.items())
            yield from (fact("attempt", action, step) for action in moment.attempted)
            yield from (fact("hpd", a, _boolean(b), step) for a, b in moment.happened.items())
            yield from (fact("doubtful", fluent, step) for fluent in sorted(moment.doubtful))
            yield from (fact("misread", fluent, step) for fluent in sorted(moment.misread))
            yield from (fact("failing", action, step) for action in moment.failing)
        yield fact("current_step", self.step)


@dataclass(frozen=True)
class Record:
    """What one step of a history says of the domain, without the mental part of the theory.

    `observed` are literals, `attempt` the agent's physical action with whether it took effect,
    `failing` if its execution failed though it may have been possible, `reported` the exogenous
    actions that happened, `goal` whether the goal was seen to hold.
    """

    observed: tuple[Literal, ...] = ()
    attempt: tuple[Action, bool] | None = None
    reported: tuple[Action, ...] = ()
    goal: bool | None = None
    failing: bool = False


def record_of(moment: Moment, knowledge: Knowledge) -> Record:
    """What a moment says of a domain."""
    own, others = knowledge.actions
    physical = next((a for a in moment.attempted if a in own), None)
    trusted = moment.trusted
    return Record(
        observed=tuple(f if truth else f.complement for f, truth in trusted.items() if f != GOAL),
        attempt=None if physical is None else (physical, moment.happened[physical]),
        failing=physical in moment.failing,
        reported=tuple(a for a, truth in moment.happened.items() if truth and a in others),
        goal=trusted.get(GOAL),
    )


@dataclass(frozen=True)
class Problem:
    """What there is to explain: the records up to `step`, with a goal that some of them tell of.

    `since` is the first step at which an event may have occurred.
    """

    goal: Goal
    records: Mapping[int, Record]
    step: int
    since: int

    @property
    def externals(self) -> list[Symbol]:
        """past(I), reported(E,I), attempted(A,I) and failing(I)."""
        atoms = [fact("past", time) for time in range(self.since, self.step)]
        for time, record in self.records.items():
            if time < self.step:
                atoms += (fact("reported", event, time) for event in record.reported)
                if record.attempt is not None:
                    atoms.append(fact("attempted", record.attempt[0], time))
                if record.failing:
                    atoms.append(fact("failing", time))
        return atoms


def problem_of(knowledge: Knowledge, goal: Goal, history: History, since: int) -> Problem:
    """All that there is to explain of a history."""
    known = sorted(history.moments.items())
    records = {step: record_of(m, knowledge) for step, m in known if step <= history.step}
    return Problem(goal, records, history.step, since)


def _boolean(value: bool) -> str:
    return "true" if value else "false"
