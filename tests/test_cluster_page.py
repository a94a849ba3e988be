"""The examples of the page about clusters, with stand-ins for the clusters that they need."""

import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, Self

import pytest

import testbed.experiment
from testbed.config import ExperimentConfig

PAGE = (Path(__file__).parents[1] / "docs" / "clusters.md").read_text(encoding="utf-8")
ADDRESS = "tcp://192.168.0.7:8786"
CLASSES = {"dask_jobqueue": "SLURMCluster", "dask_kubernetes.operator": "KubeCluster"}


def _examples(language: str) -> list[str]:
    found = re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)
    assert found
    return found


class Cluster:
    """Has what the examples use of a cluster of Dask."""

    scheduler_address = ADDRESS

    def __init__(self, **options: object) -> None: ...
    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None: ...
    def adapt(self, *, minimum: int, maximum: int) -> None: ...


@pytest.mark.parametrize("text", _examples("py"))
def test_a_program_runs_its_configuration_on_the_cluster(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module, name in CLASSES.items():
        own = ModuleType(module)
        setattr(own, name, Cluster)
        monkeypatch.setitem(sys.modules, module, own)
    monkeypatch.setitem(sys.modules, "dask_kubernetes", ModuleType("dask_kubernetes"))
    played: list[tuple[Any, ...]] = []
    monkeypatch.setattr(testbed.experiment, "run", lambda *given: played.append(given))
    exec(compile(text, "docs/clusters.md", "exec"), {})
    ((config, folder),) = played
    assert isinstance(config, ExperimentConfig)
    assert (config.runner, config.scheduler) == ("dask", ADDRESS)
    assert isinstance(folder, Path)
    assert len(text.splitlines()) <= 12


@pytest.mark.parametrize("text", _examples("bash"))
def test_a_script_can_be_read(text: str) -> None:
    done = subprocess.run(["bash", "-n"], input=text.encode(), check=False, capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")
