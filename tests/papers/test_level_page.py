"""The page of the levels published and measured, from a small run."""

import re
from pathlib import Path

import pytest

from papers.levels.__main__ import main
from papers.levels.commands import PAGE, commands
from papers.markdown import WIDTH, paragraph
from testbed.config import ExperimentConfig, load_config
from testbed.experiment.digest import digest
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import PROVENANCE, write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.store import TrialWriter, read_records
from testbed.studies.levels.published import NO_ZOOM, ZOOM
from tests.experiment.samples import a_level_record
from tests.papers.prose import says

SMALL = ["levels=[L1,L3]", "limit=3", "adversary.rate=0.2"]
DOCS = Path(__file__).parents[2] / "docs"


def _config(*overrides: str) -> ExperimentConfig:
    return load_config("levels", [*SMALL, *overrides])


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small run, played in this process."""
    folder = tmp_path_factory.mktemp("levels")
    write_config(folder, _config())
    play_missing(_config(), folder, 1, lambda _: None)
    return folder


def _page(folder: Path, capsys: pytest.CaptureFixture[str]) -> str:
    assert main([str(folder)]) == 0
    return capsys.readouterr().out


def _headings(page: str) -> list[str]:
    return [line for line in page.splitlines() if line.startswith("#")]


def test_the_page_is_made_from_a_run(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page = _page(here, capsys)
    assert digest(read_records(here)) in page
    assert says(page, 6, 6, 6)  # pairs, of the same start, and of the same goal
    assert says(page, 0, 12, 0, 0)  # not correct of all trials, lost, out of reach
    assert says(page, "65%", 3, 3)
    rows = [line for line in page.splitlines() if line.startswith("| L3 |")]
    # Of three alike the exact interval is wide: 0.025 ** (1 / 3) = 0.292.
    assert "| L3 | no zoom | 3 | 100.0% [29.2, 100.0] | 65% |" in rows
    assert any("20.07 *" in row and "83.49 *" in row for row in rows)


def test_every_table_has_rows_of_one_width(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    tables = re.findall(r"(?:^\|.*\n)+", _page(here, capsys), flags=re.MULTILINE)
    assert len(tables) == 10
    for table in tables:
        lines = table.splitlines()
        assert len(lines) > 2
        assert len({line.count("|") for line in lines}) == 1


def test_the_stored_page_has_the_parts_that_a_run_gives(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stored = (DOCS / Path(PAGE).name).read_text(encoding="utf-8")
    assert _headings(stored) == _headings(_page(here, capsys))


def _stored(folder: Path, *records: TrialRecord) -> Path:
    write_config(folder, _config("protocol=null"))
    with TrialWriter(folder) as writer:
        for record in records:
            writer.append(record)
    return folder


def test_a_run_without_the_protocols_name_is_read_and_its_failures_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = a_level_record("p", NO_ZOOM, achieved=False, in_reach=False)
    page = _page(_stored(tmp_path, a_level_record("p", ZOOM), wrong), capsys)
    assert "$ testbed replay runs/levels --trial p intentional-nozoom " in page.replace("'", "")
    assert says(page, 1, 2, 0, 1)  # not correct of all trials, lost, out of reach
    assert "### The growth" not in page
    assert "### The ratios" not in page


def test_the_page_needs_pairs_of_both_conditions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(tmp_path)]) == 2
    assert "is not a run folder" in capsys.readouterr().err
    _stored(tmp_path, a_level_record("p", ZOOM), a_level_record("q", NO_ZOOM))
    assert main([str(tmp_path)]) == 2
    told = capsys.readouterr().err
    assert told == f"{tmp_path}: has no pairs of {ZOOM} and {NO_ZOOM} at levels on record\n"


def test_the_commands_are_those_that_make_the_run_again(tmp_path: Path) -> None:
    config = _config("draw.holding=0.5", "name=mine")
    (tmp_path / PROVENANCE).write_text('{"workers": 2}', encoding="utf-8")
    run, page, picture = commands(tmp_path, config).splitlines()
    assert run == (
        "$ testbed run levels name=mine 'levels=[L1,L3]' draw.holding=0.5 limit=3 "
        "adversary.rate=0.2 --workers 2"
    )
    assert page == f"$ python -m papers.levels runs/mine > {PAGE}"
    assert picture.startswith("$ python -m papers runs/mine ")
    (tmp_path / PROVENANCE).unlink()
    assert "--workers" not in commands(tmp_path, config)


def test_paragraphs_keep_values_and_links_whole() -> None:
    link = "[Performance](performance.md#zooming)"
    lines = paragraph(" ".join(["1.00-2.00", link] * 9)).splitlines()
    assert all(len(line) <= WIDTH for line in lines)
    assert sum(line.count(link) for line in lines) == 9
