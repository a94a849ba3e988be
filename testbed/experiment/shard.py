"""A part of the trials of a run, for jobs that know nothing of each other."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Self

from testbed.experiment.specs import TrialSpec

FORM = re.compile(r"(\d{1,6})/(\d{1,6})")


@dataclass(frozen=True)
class Shard:
    """The `number`-th of `count` parts, from 1 on: every `count`-th pair of the plan."""

    number: int
    count: int

    @classmethod
    def parse(cls, text: str) -> Self:
        """The part that `I/N` names. Raises ValueError."""
        found = FORM.fullmatch(text)
        number, count = map(int, found.groups()) if found is not None else (0, 0)
        if not 1 <= number <= count:
            raise ValueError("should be I/N with I from 1 to N, such as 3/8")
        return cls(number, count)

    def __str__(self) -> str:
        return f"{self.number}/{self.count}"

    def of(self, specs: Sequence[TrialSpec]) -> list[TrialSpec]:
        """The trials of this part, of each of its pairs all."""
        pairs = groupby(specs, key=lambda spec: (spec.cell, spec.pair))
        own = (list(pair) for index, (_, pair) in enumerate(pairs) if self._has(index))
        return [spec for pair in own for spec in pair]

    def share(self, trials: int, robots: int) -> int:
        """How many of so many trials are of this part, where each pair has as many as robots."""
        return robots * len(range(self.number - 1, trials // robots, self.count))

    def _has(self, index: int) -> bool:
        return index % self.count == self.number - 1
