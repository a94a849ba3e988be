"""Random histories: what happens by definition, and how much of it is told, when, and how truly."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from random import Random

from asp import Step
from asp.language import Literal
from asp.reasoning.diagnosis import History
from benchmarks.descriptions.definition import Definition, Goal, State

_LENGTH = 4
_EVENT, _REPORTED, _LATE, _FALSE, _MISREAD, _BLIND = 0.35, 0.4, 0.4, 0.08, 0.04, 0.25


@dataclass(frozen=True)
class Life:
    """Steps without their reports, and the reports: (step told of, event, step when it is told)."""

    steps: Sequence[Step]
    reports: Sequence[tuple[int, str, int]]

    @property
    def told(self) -> list[Step]:
        """The history when everything has been told."""
        return self._heard(len(self.steps))

    def growing(self) -> Iterator[tuple[History, list[Step]]]:
        """The same history as diagnosers have it, and as steps, one step longer each time."""
        history = History()
        for now, step in enumerate(self.steps):
            for about, event, when in self.reports:
                if when == now - 1:
                    history.happened(Literal.parse(event), True, about)
            history.step = now
            history.observe(map(Literal.parse, step.observed), now)
            yield history, [*self._heard(now)[:now], replace(step, attempted=None)]
            if step.attempted:
                action = Literal.parse(step.attempted)
                history.attempt(action, now)
                history.happened(action, step.took_effect, now)

    def _heard(self, now: int) -> list[Step]:
        return [
            replace(
                step,
                reported=[e for about, e, when in self.reports if about == time and when < now],
            )
            for time, step in enumerate(self.steps)
        ]


def lived(definition: Definition, random: Random, goal: Goal | None = None) -> Life:
    """Something that happened in some initial state; with a goal it is told now and then of it."""
    steps, reports = list[Step](), dict[tuple[int, str], int]()
    state = random.choice(definition.initial)
    for time in range(_LENGTH):
        observed = _observed(definition, state, random, time)
        seen = None
        if goal is not None and random.random() < 0.3:
            seen = definition.satisfies(state, goal)
        if time == _LENGTH - 1:
            return Life([*steps, Step(observed, goal=seen)], [(*r, w) for r, w in reports.items()])
        own = _attempted(definition, state, random)
        took_effect = own is not None and bool(definition.after(state, frozenset([own])))
        done = frozenset([own] if own and took_effect else ())
        events = _events(definition, state, done, random)
        for event in definition.others:
            if random.random() < (_REPORTED if event in events else _FALSE):
                reports[time, event] = time + (
                    random.choice([1, 2]) if random.random() < _LATE else 0
                )
        steps.append(Step(observed, own, took_effect, goal=seen))
        state = random.choice(sorted(definition.after(state, done | events), key=sorted))
    raise AssertionError("a history has steps")


def _observed(definition: Definition, state: State, random: Random, time: int) -> list[str]:
    """Of the first state all, what is seen, or some; later what is seen, some, or nothing."""
    true = [each if each in state else f"-{each}" for each in definition.fluents]
    some = random.sample(true, random.randint(0, min(3, len(true))))
    seen = sorted(definition.visible(state))
    observed = random.choice([true, true, seen, some] if time == 0 else [seen, some, some, []])
    if observed and random.random() < _MISREAD:
        wrong = random.choice(observed)
        turned = wrong.removeprefix("-") if wrong.startswith("-") else f"-{wrong}"
        observed = [turned if each == wrong else each for each in observed]
    return list(observed)


def _attempted(definition: Definition, state: State, random: Random) -> str | None:
    """Mostly something that is possible."""
    possible = [a for a in definition.own if definition.after(state, frozenset([a]))]
    if random.random() < _BLIND:
        return random.choice([None, *definition.own])
    return random.choice(possible) if possible else None


def _events(
    definition: Definition, state: State, done: frozenset[str], random: Random
) -> frozenset[str]:
    """Exogenous actions that happen beside what the agent does."""
    events = frozenset(each for each in definition.others if random.random() < _EVENT)
    return events if definition.after(state, done | events) else frozenset()
