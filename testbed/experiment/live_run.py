"""A run as it stands in its folder, read while another process plays it."""

from collections import Counter
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

import msgspec

from asp.refinement import Refinement
from testbed.config import (
    ExperimentConfig,
    conditions_of,
    level_size,
    refinement_of_files,
    refinement_of_size,
)
from testbed.experiment.growing_file import GrowingFile
from testbed.experiment.plan import planned_trials
from testbed.experiment.provenance import sessions_of
from testbed.experiment.record import COARSE, FAILURES, Outcome
from testbed.experiment.run_folder import TRIALS
from testbed.experiment.shard import Shard
from testbed.experiment.status import RunStatus
from testbed.experiment.store import RETRIES
from testbed.experiment.stories import Story, StoryFile


class Played(msgspec.Struct, frozen=True, kw_only=True):
    """Of a record what is told of its trial."""

    trial: str
    scenario: str
    robot: str
    goal: list[str]
    level: str = COARSE
    cell: str = ""
    achieved: bool = False
    outcome: Outcome = "error"
    reason: str | None = None
    steps: int = 0

    @property
    def went_wrong(self) -> bool:
        """Whether the goal was not achieved, or the trial failed."""
        return not self.achieved or self.outcome in FAILURES


_played = msgspec.json.Decoder(Played)


class LiveRun:
    """The trials of a run that are on record, and where their stories are; `look` reads on.

    `outcomes` are counted by robot. What is damaged is passed over.
    """

    def __init__(self, folder: Path, config: ExperimentConfig) -> None:
        self._folder, self._robots, self._conditions = folder, config.robots, conditions_of(config)
        self._records = [GrowingFile(folder / name) for name in (TRIALS, RETRIES)]
        self._stories = StoryFile(folder)
        self._planned = sum(planned_trials(config).values())
        self._played: dict[str, Played] = {}  # in the order in which they came
        self._told: set[str] = set()
        self.outcomes: dict[str, Counter[Outcome]] = {name: Counter() for name in self._robots}

    def look(self) -> None:
        """Read what has come since the last look."""
        self._stories.look()
        for file in self._records:
            for _, line in file.new_lines():
                self._take(line)

    def _take(self, line: bytes) -> None:
        try:
            record = _played.decode(line)
        except (msgspec.DecodeError, UnicodeDecodeError):
            return
        before = self._played.pop(record.trial, None)
        if before is not None:
            self.outcomes[before.robot][before.outcome] -= 1
        if before != record:
            self._told.discard(record.trial)
        self._played[record.trial] = record
        self.outcomes.setdefault(record.robot, Counter())[record.outcome] += 1

    @property
    def status(self) -> RunStatus:
        """Trials planned, of a part those of the part, on record and failed."""
        failed = sum(own[outcome] for own in self.outcomes.values() for outcome in FAILURES)
        return RunStatus(self._of_part(), len(self._played), failed)

    def _of_part(self) -> int:
        sessions = sessions_of(self._folder)
        told = sessions[-1].get("shard") if sessions else None
        if not isinstance(told, str):
            return self._planned
        return Shard.parse(told).share(self._planned, len(self._robots))

    @property
    def began(self) -> float | None:
        """When the run began, in seconds since 1970; None where that was in several sessions."""
        sessions = sessions_of(self._folder)
        if len(sessions) != 1:
            return None
        return datetime.fromisoformat(sessions[0]["start"]).timestamp()

    def next_story(self, robot: str | None, failures: bool) -> tuple[Played, Story] | None:
        """The newest trial with a story, of one robot only, unless it was given before.

        With `failures` the newest that went wrong and was not given before comes first.
        """
        wrong = (
            own for own in self._newest(robot) if own.went_wrong and own.trial not in self._told
        )
        chosen = next(wrong, None) if failures else None
        chosen = chosen or next(self._newest(robot), None)
        if chosen is None or chosen.trial in self._told:
            return None
        self._told.add(chosen.trial)
        story = self._stories.get(chosen.trial)
        return None if story is None else (chosen, story)

    def refinement(self, played: Played) -> Refinement | None:
        """The refinement that a trial was played in; None at the coarse resolution."""
        config = self._conditions[played.cell]
        if not config.is_fine:
            return None
        if config.refinement is not None:
            return refinement_of_files(config.domain, config.refinement)
        return refinement_of_size(level_size(config, played.level))

    def _newest(self, robot: str | None) -> Iterator[Played]:
        """The trials with a story, of one robot or of all, the newest first."""
        for own in reversed(self._played.values()):
            if own.trial in self._stories and robot in (None, own.robot):
                yield own
