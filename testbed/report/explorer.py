"""The data of a page's explorer: trials step by step, with what there is to see at each.

Of a large run the page holds a sample. What it holds is chosen by the table of the run; records and
stories are read of these trials alone.
"""

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Any

import msgspec
import polars as pl
from markupsafe import Markup

from testbed.analysis import Run
from testbed.experiment.record import TrialRecord
from testbed.experiment.stories import StoryFile
from testbed.report.sample import sampled
from testbed.report.scenes import Scenes, theatre_of
from testbed.report.stories import command_of, serving_command
from testbed.report.telling import Told, facts, with_story, without_story

OUTSIDE_SCRIPTS = re.compile(r"[^ -;=-~]")
"""Characters of JSON that may not stand in a script, among some that may."""
MOST_BYTES = 4 * 2**20
"""Of the trials and drawings that a page holds."""


def study_of(run: Run) -> str:
    """What a run is for."""
    return run.config.protocol or run.config.name


class Teller:
    """Tells trials of a run from their records and stories; `study` is what the run is for."""

    def __init__(self, run: Run, study: str = "") -> None:
        self._run, self.study = run, study or study_of(run)
        counts = (
            run.table.select(pl.col("^condition\\..*$").n_unique()).collect().row(0, named=True)
        )
        self._varied = [name.partition(".")[2] for name, count in counts.items() if count > 1]

    @cached_property
    def _stories(self) -> StoryFile:
        return StoryFile(self._run.folder)

    def records(self, ids: Iterable[str]) -> dict[str, TrialRecord]:
        """The records of these trials, by trial."""
        found = self._run.records(pl.col("trial").is_in(list(ids)))
        return {record.trial: record for record in found}

    def tell(self, records: Iterable[TrialRecord], scenes: Scenes) -> list[Told]:
        """What a page knows of these trials; drawings are added."""
        return [self._told(record, scenes) for record in records]

    def about(self, record: TrialRecord) -> Told:
        """What is known of a trial besides its steps."""
        run = self._run
        return facts(record) | {
            "study": [self.study],
            "condition": {key: _value(record, key) for key in self._varied},
            "command": command_of(run.folder, record.trial),
        }

    def _told(self, record: TrialRecord, scenes: Scenes) -> Told:
        theatre = theatre_of(self._run.config, record.level)
        story = self._stories.get(record.trial)
        if story is not None and story.steps:
            steps = with_story(record, story, theatre, scenes)
        else:
            steps = without_story(record, theatre, scenes)
        return self.about(record) | {"story": steps}


def _value(record: TrialRecord, key: str) -> object:
    """What a trial was played under; of what has parts the text."""
    value = getattr(record.condition, key, None)
    known = isinstance(value, bool | int | float | str | None)
    return value if known else msgspec.json.encode(value, enc_hook=str).decode()


@dataclass(frozen=True)
class Explorer:
    """What the explorer of a page is told: `data` is JSON that may stand in a script.

    `trials` are those that the page can show; None: all, for it asks for them.
    """

    data: Markup
    trials: frozenset[str] | None

    def shows(self, trial: str) -> bool:
        """Whether the page can show a trial."""
        return self.trials is None or trial in self.trials


def explorer_of(run: Run) -> Explorer:
    """The explorer of a page that holds all trials of a run, or a sample of them."""
    scenes, teller = Scenes(), Teller(run)
    pairs = list(sampled(run.table))
    records = teller.records(chain.from_iterable(pairs))
    chosen = ([records[trial] for trial in pair] for pair in pairs)
    trials = list(_within(MOST_BYTES, chosen, teller, scenes))
    data = _script([run], served=False, trials=trials, scenes=scenes.drawn)
    return Explorer(data, frozenset(trial["id"] for trial in trials))


def served_explorer(runs: Sequence[Run]) -> Explorer:
    """The explorer of a page that holds no trials, for it asks for those of all runs."""
    return Explorer(_script(runs, served=True, trials=[], scenes=[]), None)


def _script(
    runs: Sequence[Run], *, served: bool, trials: Sequence[Told], scenes: Sequence[str]
) -> Markup:
    trials_of = (run.table.select(pl.len()).collect().item() for run in runs)
    told = {
        "command": serving_command(run.folder for run in runs),
        "total": sum(trials_of),
        "kept": len(trials),
        "served": served,
        "scenes": scenes,
        "trials": trials,
    }
    return Markup(OUTSIDE_SCRIPTS.sub(_escaped, encoded(told).decode()))


def _escaped(found: re.Match[str]) -> str:
    """A character as JSON escapes it, unless it is one that is seen."""
    character = found[0]
    if character == "<":
        return r"\u003c"
    return character if character.isprintable() else json.dumps(character)[1:-1]


def _within(
    most: int, pairs: Iterable[Sequence[TrialRecord]], teller: Teller, scenes: Scenes
) -> Iterator[Told]:
    """The trials of the first pairs that have so many bytes together with their drawings."""
    size = 0
    for pair in pairs:
        before = len(scenes.drawn)
        trials = teller.tell(pair, scenes)
        size += len(encoded(trials)) + len(encoded(scenes.drawn[before:]))
        if size > most and before:
            scenes.keep(before)
            return
        yield from trials


def encoded(told: Any) -> bytes:
    """What is told as JSON."""
    return msgspec.json.encode(told, enc_hook=str)
