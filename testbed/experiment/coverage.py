"""How much of what was planned is on record: a run that is not complete has to say so."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.plan import planned_trials
from testbed.experiment.store import read_records
from testbed.experiment.timeline import place
from testbed.text.wording import listed


@dataclass(frozen=True)
class Coverage:
    """Trials planned and on record, by scenario or level; `noun` is which of both."""

    noun: str
    planned: Mapping[str, int]
    on_record: Mapping[str, int]

    @property
    def missing(self) -> dict[str, int]:
        """How many trials are not on record, of what lacks any, in the order of the plan."""
        lacking = {name: n - self.on_record.get(name, 0) for name, n in self.planned.items()}
        return {name: number for name, number in lacking.items() if number > 0}

    def numbers(self) -> dict[str, object]:
        """The part of `summary.json`: all that were planned, and what is missing."""
        return {"planned": sum(self.planned.values()), "missing": self.missing}

    def notice(self) -> str | None:
        """What a reader has to know of a run that is not complete; None of one that is."""
        missing = self.missing
        if not missing:
            return None
        planned = sum(self.planned.values())
        head = f"{planned - sum(missing.values())} of {planned} trials are on record"
        untouched = [name for name, number in missing.items() if number == self.planned[name]]
        parts = [self._begun(name, n) for name, n in missing.items() if name not in untouched]
        if untouched:
            names = self.noun if len(untouched) == 1 else f"{self.noun}s"
            parts.append(f"none of {names} {listed(untouched)}")
        return f"{head}: {', '.join(parts)}"

    def _begun(self, name: str, missing: int) -> str:
        planned = self.planned[name]
        return f"{planned - missing} of {planned} of {self.noun} {name}"


def places_of(folder: Path) -> Iterator[tuple[str, str]]:
    """Scenario and level of each trial on record in a run folder. Raises StoreError."""
    return ((record.scenario, record.level) for record in read_records(folder))


def coverage_of(trials: Iterable[tuple[str, str]], config: ExperimentConfig) -> Coverage:
    """How much of the plan of a configuration these trials are: scenario and level of each."""
    on_record = Counter(place(scenario, level) for scenario, level in trials)
    noun = "level" if config.is_fine else "scenario"
    return Coverage(noun, planned_trials(config), on_record)
