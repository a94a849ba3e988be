"""What is to be given to make a run again: it leads back to the same configuration."""

import shutil
from pathlib import Path

import pytest

import asp
from papers.commands import ROOT, arguments
from testbed.config import ExperimentConfig, load_config
from testbed.experiment.run_folder import flat_config, read_config, write_config

DOMAINS = Path(asp.__file__).parent / "domains"
MAP = ["levels=[]", "name=mine", "domain=my.al", "refinement=my.fine", "draw.goal=[loc(book,room)]"]


def _stored(*given: str) -> ExperimentConfig:
    """The configuration of a run in the working directory."""
    folder = Path("runs/mine")
    write_config(folder, load_config(given[0], given[1:]))
    return read_config(folder)


@pytest.fixture
def own_map(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A domain and a map of one's own in the working directory."""
    monkeypatch.chdir(tmp_path)
    shutil.copyfile(DOMAINS / "office.al", "my.al")
    shutil.copyfile(DOMAINS / "office.fine", "my.fine")


def test_only_what_differs_from_the_packaged_configuration_is_given() -> None:
    given = ["name=x", "robots=[traditional]", "goal_feedback=false"]
    assert arguments(load_config("table1", given), "table1") == ["table1", *given]
    assert arguments(load_config("table1"), "table1") == ["table1"]


@pytest.mark.parametrize(
    "given",
    [
        ("levels", "levels=[L1]", "protocol=null", "draw.goal=['loc(object,room)']"),
        ("levels", "levels=[w]", "level_sizes.w={rooms: 3, rows: 4, columns: 5, objects: [[2,3]]}"),
        ("table1", "scenario_settings.3.script=[{step: 2, action: 'exo_lock(library)'}]"),
        ("table1", "scenarios=[random]", "adversary.rate=0.3", "goal=['loc(book1,library)']"),
    ],
)
def test_what_is_given_leads_back_to_the_configuration(given: tuple[str, ...]) -> None:
    config = load_config(given[0], given[1:])
    packaged, *overrides = arguments(config, given[0])
    assert flat_config(load_config(packaged, overrides)) == flat_config(config)


@pytest.mark.usefixtures("own_map")
def test_a_map_of_ones_own_is_named_where_the_run_has_it() -> None:
    config = _stored("levels", *MAP)
    packaged, *overrides = arguments(config, "levels")
    assert {"domain=runs/mine/my.al", "refinement=runs/mine/my.fine"} <= set(overrides)
    assert not any("\n" in item or " text" in item for item in overrides)
    assert flat_config(load_config(packaged, overrides)) == flat_config(config)


@pytest.mark.usefixtures("own_map")
def test_a_domain_of_the_examples_is_named_there_and_only_if_it_is_the_same() -> None:
    example = ROOT / "examples" / "near-first.al"
    given = ["table1", "name=mine", "scenarios=[random]", "domain=near-first.al"]
    shutil.copyfile(example, example.name)
    assert "domain=examples/near-first.al" in arguments(_stored(*given), "table1")
    with Path(example.name).open("a", encoding="utf-8") as file:
        file.write("\n% another one\n")
    assert "domain=runs/mine/near-first.al" in arguments(_stored(*given), "table1")
