"""The interface of a study: an experiment that configurations name, and its analysis.

A study is three functions. `measures` counts what it is about in the trials of a run, `numbers`
tells that to other programs, in `summary.json`, and `sections` shows it to people, at the terminal
and in the report. A configuration has `protocol: NAME` with the name of a packaged study, or one
that a distribution registers as an entry point of `intention_testbed.studies`; or it has
`protocol: module:OBJECT`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from testbed.analysis.condition import deviations
from testbed.config import ExperimentConfig, Finding, load_config
from testbed.registry import Registry, RegistryError
from testbed.studies.charts import Chart, Key
from testbed.studies.tables import Sheet, View
from testbed.text import listed

if TYPE_CHECKING:  # which loads polars
    from testbed.analysis import Run

Numbers = Mapping[str, Any]
Found = TypeVar("Found")


@dataclass(frozen=True)
class Section:
    """A part of a report: `views` compare, `sheets` stand folded up behind them.

    `template` is a file that extends `section.html.j2` by prose, which may use `values`; without
    one there is none.
    """

    name: str
    title: str
    views: Sequence[View] = ()
    charts: Sequence[Chart] = ()
    legend: Sequence[Key] = ()
    sheets: Sequence[Sheet] = ()
    template: Path | None = None
    values: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class Study(Generic[Found]):
    """An experiment, and what is counted of its runs.

    Args:
        measures: What the trials of a run come to, which is told whether the published figures
            apply to it; None where none of its trials is for the study.
        numbers: What is added to the summary of a run, key by key, also inside of its parts.
        sections: The study's part of the report; its views are also shown at the terminal.
        fine: Whether its trials are played at the fine resolution, else in scenarios.
        published: The name of the packaged configuration that plays the study as it was published;
            None where nothing was. Figures that were published stand beside a run that names the
            study, and differs from that configuration at most in which trials are played.
        every: Whether the study also reads the runs at its resolution that do not name it.
        compares: Whether its sections have the comparison of the robots, and how far they are from
            the optimum; the report then has none of its own.
    """

    measures: Callable[[Run, bool], Found | None]
    numbers: Callable[[Found], Numbers]
    sections: Callable[[Found], Sequence[Section]]
    fine: bool = False
    published: str | None = None
    every: bool = False
    compares: bool = False

    def deviations(self, config: ExperimentConfig) -> tuple[str, ...]:
        """In what a configuration is not the published one."""
        return () if self.published is None else deviations(config, load_config(self.published))


NAMES = (
    "attention",
    "knowledge",
    "levels",
    "observability",
    "rate",
    "table1",
    "ties",
    "tournament",
)
"""The packaged studies."""
OF_SWEEPS = "testbed.studies.sweeps:SWEEP"
"""The study that reads the sweeps whose configuration names none."""
STUDIES: Registry[Study[Any]] = Registry(
    "study",
    "intention_testbed.studies",
    {name: f"testbed.studies.{name}:STUDY" for name in NAMES},
    lambda found: None if isinstance(found, Study) else "is not a testbed.studies.Study",
)


def study_findings(config: ExperimentConfig) -> Iterator[Finding]:
    """What is wrong with the study that a configuration names: a place and a message."""
    if config.protocol is None:
        return
    try:
        study = STUDIES.find(config.protocol)
    except RegistryError as error:
        yield ("protocol",), str(error)
        return
    if study.fine != config.is_fine:
        fitting = " or ".join(n for n, own in STUDIES.usable() if own.fine == config.is_fine)
        its, here = ("scenarios", "levels") if config.is_fine else ("levels", "scenarios")
        yield ("protocol",), f"{config.protocol} is about {its}; for {here} it is: {fitting}"


@dataclass(frozen=True)
class Results:
    """What a study has to say of a run."""

    study: Study[Any]
    numbers: Numbers
    sections: tuple[Section, ...]


def results_of(run: Run) -> list[Results]:
    """What the studies of a run come to; those that find nothing in it are left out."""
    return [
        Results(study, study.numbers(found), tuple(study.sections(found)))
        for study, as_published in _studies(run.config)
        if (found := study.measures(run, as_published)) is not None
    ]


def _studies(config: ExperimentConfig) -> Iterator[tuple[Study[Any], bool]]:
    """The studies that read a run, each with whether its published figures apply."""
    named = (
        STUDIES.find(config.protocol or OF_SWEEPS) if config.protocol or config.is_sweep else None
    )
    if named is not None:
        yield named, not named.deviations(config)
    for _, study in STUDIES.usable():
        if study is not named and study.every and study.fine == config.is_fine:
            yield study, False


def left_out(config: ExperimentConfig) -> str | None:
    """Why published figures do not stand beside those of a run that names a study; None if so."""
    if config.protocol and (names := STUDIES.find(config.protocol).deviations(config)):
        return f"published figures are left out: {listed(names)} not as in the published experiment"
    return None
