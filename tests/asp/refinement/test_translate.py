"""`testbed translate` prints the program of a refinement."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from tests.asp.reasoning.diagrams import warnings_of

RUNNER = CliRunner()


def test_it_prints_the_strong_refinement_with_what_each_law_came_from() -> None:
    result = RUNNER.invoke(app, ["translate", "office.fine"])
    assert result.exit_code == 0
    assert warnings_of(result.stdout) == []
    lines = result.stdout.split("\n")
    (move,) = [
        line for line in lines if line.startswith("holds(fine_loc(R,C),I+1) :- occurs(fine_move")
    ]
    assert move.endswith("  % line 30: move(R, L) causes loc(R, L).")
    assert any(line.startswith("holds(observed_fine_loc(") for line in lines)
    assert (
        "% Bridge axioms: a coarse fluent holds where its counterpart holds of components." in lines
    )


@pytest.mark.parametrize(
    "text", ["magnify\n  room into cell.\n", "refines office.\nmagnify\n  rom into c.\n"]
)
def test_a_mistake_is_one_line_with_its_place(text: str, tmp_path: Path) -> None:
    file = tmp_path / "wrong.fine"
    file.write_text(text, encoding="utf-8")
    result = RUNNER.invoke(app, ["translate", str(file)])
    assert result.exit_code == 2
    assert result.stderr.startswith(f"{file}:")
    assert result.stderr.count("\n") == 1
