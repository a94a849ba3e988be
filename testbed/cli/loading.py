"""Configurations that may be run here: with the robots, adversaries and studies that there are."""

from collections.abc import Sequence
from pathlib import Path

from testbed.config import Check, ConfigError, ExperimentConfig, dotted, load_config, with_sweep
from testbed.experiment.checks import CHECKS, person_findings
from testbed.experiment.plan import sweep_findings
from testbed.experiment.provenance import modules_of
from testbed.experiment.run_folder import as_played, is_stored
from testbed.registry import search_as_told, search_last
from testbed.studies import study_findings


def load(
    source: str | Path,
    overrides: Sequence[str] = (),
    sweep: bool = False,
    checks: Sequence[Check] = (*CHECKS, person_findings),
) -> ExperimentConfig:
    """The configuration of a file or a packaged name, with overrides. Raises ConfigError.

    With `sweep` overrides with several values, or a range, are swept. `checks` are of what it
    calls by name.

    What lies beside the file can be imported from then on, but nothing in the place of ours. One
    that is stored in a run folder is read as there.
    """
    if Path(source).is_file():
        search_beside(Path(source))
    else:
        search_as_told()
    given = with_sweep(overrides) if sweep else overrides
    config = load_config(source, given, (*checks, study_findings))
    if twins := [f"{source}: {dotted(key)}: {told}" for key, told in sweep_findings(config)]:
        raise ConfigError(twins)
    return as_played(config) if is_stored(Path(source)) else config


def search_beside(config: Path) -> None:
    """Let modules be found that lie beside a configuration; of a stored one where those lay."""
    folder = config.resolve().parent
    search_last(modules_of(folder) or folder)
