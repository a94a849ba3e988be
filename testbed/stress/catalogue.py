"""What a search has found: kinds of findings, how often each was met, and its simplest episode."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from testbed.experiment.specs import TrialSpec
from testbed.stress.units import Branching, Drawing, Judged, Result, Unit
from testbed.stress.verdicts import Finding


class Kind(NamedTuple):
    """Findings that are alike: of one robot, about one rule, after events of these names."""

    robot: str
    objective: str
    rule: str
    events: tuple[str, ...]

    def __str__(self) -> str:
        after = f" after {', '.join(self.events)}" if self.events else " without events"
        return f"{self.robot}: {self.objective}, {self.rule}{after}"


class Group(NamedTuple):
    """Episodes of one robot with so many events, under one condition of a sweep ("" of none)."""

    robot: str
    condition: str
    events: int


class Example(NamedTuple):
    """An episode with a finding: fewer events are simpler, then fewer steps, then likelier ones."""

    events: int
    length: int
    unlikely: float
    text: str
    case: TrialSpec
    judged: Judged
    finding: Finding


@dataclass
class Catalogue:
    """What was played so far, and what was found in it.

    `kinds` has the simplest episode of each, `met` the number of episodes of each, `under` the
    conditions. Of each group of episodes `episodes` is the number, `failed` that of those with a
    finding. `left_out` are next events that were not tried.
    """

    units: int = 0
    cases: int = 0
    left_out: int = 0
    episodes: Counter[Group] = field(default_factory=Counter)
    failed: Counter[Group] = field(default_factory=Counter)
    met: Counter[Kind] = field(default_factory=Counter)
    under: dict[Kind, set[str]] = field(default_factory=dict)
    kinds: dict[Kind, Example] = field(default_factory=dict)
    greatest: dict[str, float] = field(default_factory=dict)

    @property
    def most_events(self) -> int:
        """The most events of an episode that was played."""
        return max((own.events for own in self.episodes), default=0)

    def hear(self, unit: Unit, result: Result) -> list[Kind]:
        """Take in the result of a unit; the kinds that are new."""
        robot, known = unit.case.robot, len(self.kinds)
        self.units += 1
        self.cases += isinstance(unit, Branching) and not unit.events
        self.left_out += result.left_out
        for judged in result.judged:
            group = Group(robot, unit.case.cell, len(judged.events))
            self.episodes[group] += 1
            self.failed[group] += bool(judged.findings)
            self.greatest[robot] = max(judged.score, self.greatest.get(robot, 0.0))
            for kind, finding in _kinds(robot, judged):
                self._take(kind, unit, judged, finding)
        return list(self.kinds)[known:]

    def _take(self, kind: Kind, unit: Branching | Drawing, judged: Judged, found: Finding) -> None:
        self.met[kind] += 1
        self.under.setdefault(kind, set()).add(unit.case.cell)
        unlikely = -(judged.chance or 0.0)
        text = f"{unit.case.trial} {judged.events}"
        size = len(judged.events), judged.length, unlikely, text
        example = Example(*size, unit.case, judged, found)
        if kind not in self.kinds or example[:4] < self.kinds[kind][:4]:
            self.kinds[kind] = example


def _kinds(robot: str, judged: Judged) -> Iterator[tuple[Kind, Finding]]:
    """Each kind once per episode."""
    names = tuple(event.name for _, event in judged.events)
    found = {(own.objective, own.rule): own for own in reversed(judged.findings)}
    for (objective, rule), finding in found.items():
        yield Kind(robot, objective, rule, names), finding
