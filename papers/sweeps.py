"""Print the page of the packaged sweeps, made from a run folder of each."""

import argparse
import shlex
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from papers.commands import arguments, place
from papers.text import render
from testbed.analysis import load_run
from testbed.config import ConfigError
from testbed.experiment import StoreError
from testbed.studies import Section, results_of, rows_of
from testbed.studies.sweeps import Found, found_in
from testbed.studies.table1.published import BASELINE, INTENTIONAL

BAD_INPUT = 2
PAGE = "docs/sweeps.md"


@dataclass(frozen=True)
class Study:
    """A run of a packaged study, as its section of the page shows it."""

    name: str
    section: Section
    found: Found
    trials: int
    digest: str
    rate: float | None
    commands: list[str]

    @property
    def picture(self) -> str:
        return f"images/{self.name}.svg"

    @property
    def keys(self) -> Sequence[str]:
        """The names of the conditions."""
        return list(self.found.robots)

    def share(self, condition: str, robot: str) -> str:
        """How many trials of a robot achieve the goal under a condition."""
        own = self.found.robots[condition]["achieved"][robot]
        return "none" if own is None else f"{own.value:.0%}"

    def below(self, robot: str) -> int:
        """The number of conditions under which not every trial of a robot achieves the goal."""
        return sum(own < 1.0 for own in self._shares(robot))

    def least(self, robot: str, among: str = "") -> str:
        """The least share of a robot's trials that achieve the goal, over the conditions.

        With a point of an axis, over those at that point.
        """
        return f"{min(self._shares(robot, among)):.0%}"

    def most(self, robot: str, among: str = "") -> str:
        """The same of the greatest share."""
        return f"{max(self._shares(robot, among)):.0%}"

    def spread(self, robot: str, among: str = "") -> str:
        """Both: one where they are the same."""
        least, most = self.least(robot, among), self.most(robot, among)
        return least if least == most else f"{least} to {most}"

    def _shares(self, robot: str, among: str = "") -> list[float]:
        own = self.found.robots.items()
        shares = [has["achieved"][robot] for name, has in own if among in ("", *name.split(", "))]
        return [share.value for share in shares if share is not None]

    @property
    def ceiling(self) -> str:
        """Where not every trial of the intentional robot achieves the goal, as a sentence."""
        robot, other = INTENTIONAL, BASELINE
        least = f"its least share is {self.least(robot)}, that of TP {self.least(other)}"
        below = f"{self.below(robot)} of {len(self.keys)} conditions"
        return f" ATI leaves its ceiling in {below}; {least}."

    @property
    def columns(self) -> Sequence[str]:
        return self.section.views[0].columns

    @property
    def rows(self) -> list[tuple[str, ...]]:
        return list(rows_of(self.section.views[0].lines))


def study_of(folder: Path) -> Study:
    """The study that a run is of. Raises StoreError for a run that is of no sweep."""
    run = load_run(folder)
    if not run.config.is_sweep or run.config.protocol is None:
        raise StoreError(f"{folder}: is no run of a packaged sweep")
    (found,), name = results_of(run), run.config.protocol
    where = shlex.quote(place(run.config))
    commands = [
        f"$ {shlex.join(['testbed', 'run', *arguments(run.config, name)])}",
        f"$ python -m papers {where} docs/images/{name}.svg",
    ]
    return Study(
        name,
        found.sections[0],
        found_in(run),
        len(run.trials),
        run.digest,
        run.config.adversary.rate,
        commands,
    )


def main(given: Sequence[str] | None = None) -> int:
    """The exit code: 0, or 2 with one line about what cannot be read."""
    parser = argparse.ArgumentParser("python -m papers.sweeps", description=__doc__)
    parser.add_argument("folders", type=Path, metavar="DIR", nargs="+", help="run folders")
    try:
        studies = [study_of(folder) for folder in parser.parse_args(given).folders]
    except (StoreError, ConfigError, OSError) as error:
        print(error, file=sys.stderr)
        return BAD_INPUT
    print(render("sweeps", studies={own.name: own for own in studies}, page=PAGE), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
