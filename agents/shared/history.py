"""What an agent remembers: the history (D 2.3), and the activities it has built."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from clingo import Symbol

from asp.language import atom, is_positive
from asp.solving import fact
from testbed.protocol import Event

GOAL = "my_goal"


@dataclass(frozen=True)
class Activity:
    """A plan made for the goal: its name (1, 2, ...) and its physical actions."""

    name: int
    plan: tuple[str, ...]


@dataclass
class Moment:
    """What the history says of one step.

    `observed` has the truth of fluents, `attempted` the agent's actions of any kind, `happened`
    whether an action, the agent's own or another's, took effect; `failing` are attempts whose
    execution failed though they may have been possible. Of the observed fluents the `doubtful` ones
    rest on tests, and the `misread` ones are taken for wrong.
    """

    observed: dict[str, bool] = field(default_factory=dict)
    attempted: list[str] = field(default_factory=list)
    happened: dict[str, bool] = field(default_factory=dict)
    failing: list[str] = field(default_factory=list)
    doubtful: frozenset[str] = frozenset()
    misread: frozenset[str] = frozenset()

    @property
    def trusted(self) -> dict[str, bool]:
        """What was observed and is not taken for wrong."""
        return {f: truth for f, truth in self.observed.items() if f not in self.misread}


@dataclass
class History:
    """Statements obs, hpd, attempt, failing, doubtful and misread of all steps up to `step`."""

    step: int = 0
    activities: list[Activity] = field(default_factory=list)
    moments: dict[int, Moment] = field(default_factory=dict)
    late_news: int = 0

    def at(self, step: int) -> Moment:
        """What is recorded of a step; made when it is first asked for."""
        return self.moments.setdefault(step, Moment())

    def observe(self, literals: Iterable[str], step: int) -> None:
        """obs(F,B,I) for each literal."""
        moment = self.at(step)
        for literal in literals:
            moment.observed[atom(literal)] = is_positive(literal)

    def doubt(self, literals: Iterable[str], step: int) -> None:
        """doubtful(F,I) for those of the literals that were observed."""
        moment = self.at(step)
        moment.doubtful |= moment.observed.keys() & set(map(atom, literals))

    def distrust(self, wrong: Iterable[tuple[int, str]]) -> None:
        """misread(F,I) for exactly these steps and fluents; it is news of the past."""
        self.late_news += 1
        pairs = frozenset(wrong)
        for step, moment in self.moments.items():
            moment.misread = frozenset(fluent for time, fluent in pairs if time == step)

    @property
    def misread(self) -> tuple[Event, ...]:
        """The observations that are taken for wrong, by fluent."""
        steps = sorted(self.moments.items())
        return tuple(Event(step=s, action=f) for s, m in steps for f in sorted(m.misread))

    @property
    def has_doubts(self) -> bool:
        """Whether any observation rests on tests."""
        return any(moment.doubtful for moment in self.moments.values())

    def happened(self, action: str, truth: bool, step: int) -> None:
        """hpd(A,B,I). News of a step before the last one is counted in `late_news`."""
        self.late_news += step < self.step
        self.at(step).happened[action] = truth

    def attempt(self, action: str, step: int) -> None:
        """attempt(A,I)."""
        self.at(step).attempted.append(action)

    def failed(self, action: str, step: int) -> None:
        """failing(A,I)."""
        self.at(step).failing.append(action)

    def facts(self) -> Iterator[Symbol]:
        """The history as facts for the theory, step by step, without the activities."""
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

    def activity_facts(self) -> Iterator[Symbol]:
        """What the theory knows of each activity: its goal, its components, its length."""
        for activity in self.activities:
            yield fact("activity_goal", activity.name, GOAL)
            yield fact("activity_length", activity.name, len(activity.plan))
            for index, action in enumerate(activity.plan, start=1):
                yield fact("activity_component", activity.name, index, action)

    @property
    def longest(self) -> int:
        """The length of the longest plan so far."""
        return max((len(activity.plan) for activity in self.activities), default=0)


@dataclass(frozen=True)
class Diagnosis:
    """An explanation of a history: exogenous events that nobody reported, and how it began.

    `distrusted` are reports of events that did not happen, and attempts that were not executed;
    `exceptions` are names of the domain's defaults, `initial` literals of the inertial fluents of
    which nothing was observed at step 0; both are sorted. `proved` says whether it is known that no
    explanation is smaller.
    """

    unobserved: tuple[Event, ...] = ()
    distrusted: tuple[Event, ...] = ()
    exceptions: tuple[str, ...] = ()
    initial: tuple[str, ...] = ()
    proved: bool = field(default=True, compare=False)

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
            yield fact(f"{predicate}_initial", atom(literal), _boolean(is_positive(literal)))

    @property
    def size(self) -> int:
        """How many events, and false reports and attempts, it assumes (27)."""
        return len(self.unobserved) + len(self.distrusted)


def _boolean(value: bool) -> str:
    return "true" if value else "false"
