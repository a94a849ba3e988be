"""A domain has one robot: a second one is refused where its sort stands."""

from pathlib import Path

import pytest

import asp
from testbed import office_v0
from testbed.cli import app
from testbed.config import ConfigError, load_config
from tests.greenhouse import GREENHOUSE

TEXT = "name: pots\ndomain: pots.al\ngoal: ['stands(fern,sill)']\n"
TWO = GREENHOUSE.replace("{gardener}", "{gardener, nephew}")
ONE_SEES = TWO.replace("R sees stands(P, S) if robot(R)", "gardener sees stands(P, S)")
UNALIKE = (
    GREENHOUSE.replace("  pot  ", "  drone = {buzz}.\n  pot  ")
    .replace("actions\n", "actions\n  agent     lift(drone, pot).\n")
    .replace("sees\n", "sees\n  D sees stands(P, S) if drone(D).\n")
)
CREW = (
    GREENHOUSE.replace("{gardener}.", "{gardener}.\n  helper = {nephew}.\n  crew = robot + helper.")
    .replace("carry(robot, pot, spot)", "carry(crew, pot, spot)")
)  # fmt: skip


def _folder(folder: Path, domain: str) -> Path:
    (folder / "pots.al").write_text(domain, encoding="utf-8")
    (folder / "pots.yaml").write_text(TEXT, encoding="utf-8")
    return folder / "pots.yaml"


@pytest.mark.parametrize(
    ("domain", "line", "second"),
    [(TWO, 2, "nephew"), (ONE_SEES, 2, "nephew"), (UNALIKE, 2, "gardener"), (CREW, 3, "nephew")],
)
def test_two_robots_are_refused_where_the_second_one_stands(
    tmp_path: Path, domain: str, line: int, second: str
) -> None:
    path = _folder(tmp_path, domain)
    with pytest.raises(ConfigError) as caught:
        load_config(path)
    (said,) = caught.value.lines
    assert said.startswith(f"{tmp_path / 'pots.al'}:{line}:")
    assert second in said


def test_the_commands_and_the_environment_refuse_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = _folder(tmp_path, TWO)
    for command in (["check", str(path)], ["run", str(path), "--out", str(tmp_path / "run")]):
        with pytest.raises(SystemExit) as ended:
            app(command)
        assert ended.value.code == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith(f"{tmp_path / 'pots.al'}:2:")
    assert not (tmp_path / "run").exists()
    with pytest.raises(ConfigError) as caught:
        office_v0.env(config=path)
    assert caught.value.lines[0].startswith(f"{tmp_path / 'pots.al'}:2:")


def test_two_robots_are_refused_at_the_fine_resolution(tmp_path: Path) -> None:
    path = _folder(tmp_path, TWO)
    (tmp_path / "pots.fine").write_text("refines pots.al.\n", encoding="utf-8")
    with pytest.raises(ConfigError) as caught:
        load_config(path, [f"refinement={tmp_path / 'pots.fine'}", "limit=1"])
    assert caught.value.lines[0].startswith(f"{tmp_path / 'pots.al'}:2:")


SEEING_POTS = (
    GREENHOUSE.replace("fluents\n", "fluents\n  inertial at(thing, spot).\n")
    .replace("  spot  =", "  thing = robot + pot.\n  spot  =")
    .replace("sees\n", "sees\n  R sees at(P, S) if at(R, S), robot(R).\n")
    .replace("if robot(R).", "if at(R, S).")
)


def test_what_is_acted_upon_is_no_robot_although_a_variable_lets_it_see(tmp_path: Path) -> None:
    """In `R sees f if at(R, S)` everything that is at a spot sees: the pots do, too."""
    path = _folder(tmp_path, SEEING_POTS)
    assert asp.load_description(str(tmp_path / "pots.al")).robots == ("gardener", "fern", "rose")
    assert load_config(path).robots == ("intentional", "traditional")
