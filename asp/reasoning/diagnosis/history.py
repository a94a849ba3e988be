"""Histories (D 2.3), and explanations of them (D 2.4)."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple, Protocol, TypeVar

from clingo import Symbol

from asp.language import Action, Fluent, Literal
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


@dataclass
class History:
    """Statements obs, hpd, attempt, failing, doubtful and misread of all steps up to `step`.

    `late_news` counts the statements about earlier steps than the last one.
    """

    step: int = 0
    moments: dict[int, Moment] = field(default_factory=dict)
    late_news: int = 0

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
        self.late_news += 1
        pairs = frozenset(wrong)
        for step, moment in self.moments.items():
            moment.misread = frozenset(fluent for time, fluent in pairs if time == step)

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
        self.late_news += step < self.step
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
            for fluent, truth in moment.observed.items():
                yield fact("obs", fluent, _boolean(truth), step)
            for action in moment.attempted:
                yield fact("attempt", action, step)
            for action, truth in moment.happened.items():
                yield fact("hpd", action, _boolean(truth), step)
            for fluent in sorted(moment.doubtful):
                yield fact("doubtful", fluent, step)
            for fluent in sorted(moment.misread):
                yield fact("misread", fluent, step)
            for action in moment.failing:
                yield fact("failing", action, step)
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

    @property
    def action(self) -> Action | None:
        """The attempted action, if any."""
        return None if self.attempt is None else self.attempt[0]

    @property
    def distrustable(self) -> tuple[Action, ...]:
        """What may be distrusted of the step: reports, and an attempt that failed."""
        failed = (self.attempt[0],) if self.attempt is not None and self.failing else ()
        return (*self.reported, *failed)


def record_of(moment: Moment, own: Collection[Action], others: Collection[Action]) -> Record:
    """What a moment says of a domain with these actions of the agent's own, and exogenous ones."""
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
class Explanation:
    """What makes a history consistent: exogenous events that nobody reported, and how it began.

    `distrusted` are reports of events that did not happen, and attempts that were not executed;
    `exceptions` are names of the domain's defaults, `initial` literals of the inertial fluents of
    which nothing was observed at step 0. All are sorted. `proved` says whether it is known that no
    explanation is smaller.
    """

    unobserved: tuple[Happening, ...] = ()
    distrusted: tuple[Happening, ...] = ()
    exceptions: tuple[str, ...] = ()
    initial: tuple[Literal, ...] = ()
    proved: bool = field(default=True, compare=False)

    @property
    def size(self) -> int:
        """How many events, and false reports and attempts, it assumes (27)."""
        return len(self.unobserved) + len(self.distrusted)

    def facts(self, predicate: str) -> Iterator[Symbol]:
        """predicate(PEA,I) for each event, and predicate_distrusted(A,I) for what is distrusted.

        Also predicate_exception(D), predicate_initial(F,B).
        """
        for event in self.unobserved:
            yield fact(predicate, event.action, event.step)
        for report in self.distrusted:
            yield fact(f"{predicate}_distrusted", report.action, report.step)
        for default in self.exceptions:
            yield fact(f"{predicate}_exception", default)
        for literal in self.initial:
            yield fact(f"{predicate}_initial", literal.atom, _boolean(literal.is_positive))

    def happened(self, record: Record, step: int) -> tuple[Action, ...]:
        """The exogenous actions of a step that has this record."""
        trusted = (e for e in record.reported if (step, e) not in self.distrusted)
        return (*trusted, *(event.action for event in self.unobserved if event.step == step))

    def executed(self, record: Record, step: int) -> Action | None:
        """The agent's action of a step that has this record; None where none was executed."""
        return None if (step, record.action) in self.distrusted else record.action

    def followed_by(self, suffix: Explanation, first: int) -> Explanation:
        """This and an explanation of the history from step `first` on."""
        unobserved, distrusted = (
            tuple(Happening(first + step, action) for step, action in happenings)
            for happenings in (suffix.unobserved, suffix.distrusted)
        )
        return replace(
            self, unobserved=self.unobserved + unobserved, distrusted=self.distrusted + distrusted
        )

    def left(self, history: History) -> Explanation:
        """What is left to assume of it where some of its events were reported since."""
        unobserved = (e for e in self.unobserved if not history.at(e.step).happened.get(e.action))
        return replace(self, unobserved=tuple(unobserved))

    @property
    def without_start(self) -> Explanation:
        """The same, whatever it says of unknown fluents at step 0."""
        return replace(self, initial=())


@dataclass(frozen=True)
class Diagnosis:
    """An explanation of a history, and the indices of active activities, by name.

    `alternatives` gives at most so many explanations of the same size, and whether there are more;
    where it is None they have to be looked for.
    """

    explanation: Explanation
    indices: Mapping[int, int] = field(default_factory=dict)
    alternatives: Callable[[int], tuple[list[Explanation], bool]] | None = field(
        default=None, compare=False, repr=False
    )


class InconsistentHistoryError(Exception):
    """No exceptions to defaults and no exogenous actions explain what was observed."""


H_contra = TypeVar("H_contra", bound=History, contravariant=True)


class Diagnoser(Protocol[H_contra]):
    """Explains one history after another step of it: the reference, or its incremental twin."""

    def diagnose(self, history: H_contra, adopted: Explanation, /) -> Diagnosis:
        """The adopted explanation if it still explains the history, else the first smallest one.

        The order is that of `order.lp`. Raises InconsistentHistoryError and LimitError.
        """


def _boolean(value: bool) -> str:
    return "true" if value else "false"
