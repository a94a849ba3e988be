"""What a robot is told of exogenous actions: true reports and false ones, some of them late."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

import numpy as np

from asp.language import Literal
from asp.language import literals as text
from testbed.environment.execution import Execution
from testbed.environment.rules import Observability
from testbed.protocol import Event
from testbed.world import World


@dataclass(frozen=True)
class Played:
    """A step as it was played: the robot's part of the compound action, and the event, if any.

    `possible` says whether an event might have been instead.
    """

    step: int
    before: int
    effective: tuple[str, ...]
    event: str | None
    after: int
    possible: Callable[[str], bool]


@dataclass(frozen=True)
class News:
    """Draws the reports of a step, by the rules for each kind of event."""

    world: World
    execution: Execution

    def reports(
        self, played: Played, rules: Mapping[str, Observability], random: np.random.Generator
    ) -> Iterator[tuple[int, Event]]:
        """Each report with the step at which it reaches the robot."""
        told = [played.event] if self._is_told(played, rules, random) and played.event else []
        for action in (*told, *self._false_reports(played, rules, random)):
            late = rules[text.name(action)].delay
            yield played.step + 1 + late, Event(step=played.step, action=Literal.parse(action))

    def _is_told(
        self, played: Played, rules: Mapping[str, Observability], random: np.random.Generator
    ) -> bool:
        if played.event is None:
            return False
        how = rules.get(text.name(played.event), Observability())
        if how.mode == "never" or (how.mode == "colocated" and not self._witnessed(played)):
            return False
        return bool(random.random() < how.probability)

    def _witnessed(self, played: Played) -> bool:
        """Whether the robot can tell, before or after, what is as it is because of the event."""
        alone = self.world.successors(played.before, played.effective)
        without = alone[0] if alone else played.before
        changed = frozenset(self.world.true_atoms(played.after ^ without))
        return any(self.execution.notices(s, changed) for s in (played.before, played.after))

    def _false_reports(
        self, played: Played, rules: Mapping[str, Observability], random: np.random.Generator
    ) -> Iterator[str]:
        for name, how in rules.items():
            if how.false_reports > 0.0 and random.random() < how.false_reports:
                kind = [e for e in self.world.exogenous_actions if text.name(e) == name]
                others = [event for event in kind if event != played.event]
                drawn = (others[int(number)] for number in random.permutation(len(others)))
                yield from islice(filter(played.possible, drawn), 1)
