"""Tables in terminals of several widths: numbers are whole, and no line is too long."""

import os
import re
import subprocess
import sys
from pathlib import Path

import polars as pl
import pytest
from rich.cells import cell_len

from asp.language import Literal
from testbed import studies
from testbed.analysis.table import table_of
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import At, Explained
from testbed.experiment.run_folder import write_config
from testbed.experiment.store import TrialWriter
from testbed.report.tables import Row, grid, rows_of
from testbed.studies.levels.published import NO_ZOOM, PAPER, ZOOM
from testbed.text.grid import Grid
from tests.experiment.samples import Configure, a_level_record, a_record
from tests.studies.levels.found import views

WIDTHS = (60, 80, 120, 200)
ROBOTS = ("intentional", "intentional-nozoom", "traditional")
MOVES = [At(2, Literal.parse(f"exo_move(book{n},office1)")) for n in range(9)]
SEEN = [Explained(3, MOVES, [Literal.parse("-loc(b,library)")])]
ENDINGS = ("achieved", "gave_up", "step_limit", "false_finish")


def _records(trials: int) -> list[object]:
    return [
        a_record(
            f"{scenario} {robot} {number}",
            scenario=scenario,
            robot=robot,
            outcome=ENDINGS[number % 4],
            achieved=number % 4 == 0,
            plans=3,
            action_count=12345 + number,
            execution_units=67890 + number,
            planning_time_s=12.345,
            explanations=SEEN,
        )
        for scenario in ("1", "a scenario with a name of some length")
        for robot in ROBOTS
        for number in range(trials)
    ]


def _levels() -> list[Grid]:
    records = [
        a_level_record(f"p{n}", robot, level, fine=0.1 * n + 0.01)
        for level in ("L1", "L2")
        for robot in (ZOOM, NO_ZOOM)
        for n in range(30)
    ]
    return [studies.grid(view, view.title) for view in views(records, PAPER).values()]


def _rows(trials: int) -> list[Row]:
    table = table_of(_records(trials))
    return rows_of(table, pl.Series("apart", [None] * len(table), pl.String))


GRIDS = [grid(_rows(1)), grid(_rows(184)), *_levels()]


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("shown", GRIDS, ids=["one", "many", *("level",) * (len(GRIDS) - 2)])
def test_numbers_are_whole_at_every_width(shown: Grid, width: int) -> None:
    lines = list(shown.lines(width))
    assert max(map(cell_len, lines)) <= width
    assert not [line for line in lines if line != line.rstrip()]
    text = "\n".join(lines)
    for row in filter(None, shown.rows):
        for number in (row[column] for column in shown.numbers):
            assert re.search(rf"(?<!\S){re.escape(number.strip())}(?!\S)", text), number


@pytest.mark.parametrize("width", WIDTHS)
def test_text_is_whole_whatever_becomes_of_its_lines(width: int) -> None:
    words = " ".join(GRIDS[1].lines(width)).split()
    for row in filter(None, GRIDS[1].rows):
        assert {word for cell in row for word in cell.split()} <= set(words)


def test_the_widest_column_of_text_moves_below_its_row() -> None:
    wide, narrow = (list(GRIDS[1].lines(width)) for width in (200, 80))
    assert "explained by" in wide[0]
    assert "explained by" not in narrow[0]
    assert any(line.strip().startswith("explained by exception") for line in narrow)


def test_a_word_that_is_wider_than_the_terminal_is_broken() -> None:
    lines = list(Grid(("name", "n"), [("x" * 300, "17")], range(1, 2)).lines(60))
    assert max(map(len, lines)) <= 60
    assert "".join(lines).count("x") == 300
    assert re.search(r"\bn 17\b", lines[-1])


@pytest.mark.parametrize(("columns", "least"), [("60", 1), ("80", 1), ("300", 151)])
def test_what_is_piped_is_as_wide_as_columns_says(
    configure: Configure, tmp_path: Path, columns: str, least: int
) -> None:
    config = configure("scenarios=[1]", "robots=[intentional]")
    write_config(tmp_path, config)
    (spec, *_) = plan_trials(config)
    planned = {
        "pair": spec.pair,
        "seed": spec.seed,
        "initial": list(spec.initial),
        "goal": list(spec.setting.goal),
    }
    with TrialWriter(tmp_path) as writer:
        writer.append(a_record(spec.trial, **planned, explanations=SEEN))
    root = str(Path(__file__).parents[2])
    done = subprocess.run(
        [sys.executable, "-m", "testbed", "report", str(tmp_path)],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, "COLUMNS": columns, "PYTHONPATH": root},
    )
    table = done.stdout.partition("incomplete")[0].partition("digest")[0].splitlines()
    assert least <= max(map(len, table)) <= int(columns)
    assert not [line for line in done.stdout.splitlines() if line != line.rstrip()]
