"""Domains and refinements of one's own, in files as a user has them, and their trials."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import yaml

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot


@dataclass(frozen=True)
class Own:
    """A configuration in `folder`, with the domain and the refinement that it names.

    Each two texts have a folder of their own in there: worlds are remembered by their files.
    """

    folder: Path
    domain: str
    refinement: str = ""

    def write(self, **keys: Any) -> Path:
        """The configuration's file, in which these keys are given."""
        place = self.folder / sha256(f"{self.domain}{self.refinement}".encode()).hexdigest()[:12]
        place.mkdir(parents=True, exist_ok=True)
        (place / "own.al").write_text(self.domain, encoding="utf-8")
        named: dict[str, Any] = {"name": "own", "domain": "own.al", "link": "inprocess"}
        if self.refinement:
            (place / "own.fine").write_text(self.refinement, encoding="utf-8")
            named |= {"refinement": "own.fine", "limit": 1}
        file = place / "own.yaml"
        file.write_text(yaml.safe_dump({**named, "observability": {}, **keys}), encoding="utf-8")
        return file

    def play(self, **keys: Any) -> Iterator[tuple[TrialRecord, Sequence[Moment]]]:
        """The trials one after the other, each with its steps. Raises ConfigError."""
        client = InProcessRobot(make_robot)
        for spec in plan_trials(load_config(self.write(**keys))):
            moments: list[Moment] = []
            yield play_trial(spec, client, moments.append).record, moments
