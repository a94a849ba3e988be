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

    `kinds` has the simplest episode of each, `met` the number of episodes of each, `episodes` those
    played by robot; `left_out` are next events that were not tried.
    """

    units: int = 0
    cases: int = 0
    left_out: int = 0
    episodes: Counter[str] = field(default_factory=Counter)
    failed: Counter[str] = field(default_factory=Counter)
    met: Counter[Kind] = field(default_factory=Counter)
    kinds: dict[Kind, Example] = field(default_factory=dict)
    greatest: dict[str, float] = field(default_factory=dict)

    def hear(self, unit: Unit, result: Result) -> list[Kind]:
        """Take in the result of a unit; the kinds that are new."""
        robot, known = unit.case.robot, len(self.kinds)
        self.units += 1
        self.cases += isinstance(unit, Branching) and not unit.events
        self.left_out += result.left_out
        self.episodes[robot] += len(result.judged)
        for judged in result.judged:
            self.failed[robot] += bool(judged.findings)
            self.greatest[robot] = max(judged.score, self.greatest.get(robot, 0.0))
            for kind, finding in _kinds(robot, judged):
                self._take(kind, unit, judged, finding)
        return list(self.kinds)[known:]

    def _take(self, kind: Kind, unit: Branching | Drawing, judged: Judged, found: Finding) -> None:
        self.met[kind] += 1
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
