"""Refinements of one's own: what has no components, tests by sorts, goals that are given."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from benchmarks.own import Own
from benchmarks.own_domains import Domain
from benchmarks.own_refinements import Refined
from testbed import office_v0
from testbed.cli import app
from tests.experiment.gardens import GARDEN, ROWS

RAKED = GARDEN.replace("OTHER", "rake")
GOAL = ["stands(spade,south)", "-carries(tom,spade)"]


@pytest.mark.parametrize("robot", ["intentional", "intentional-nozoom"])
def test_what_has_no_components_is_in_the_cell_of_its_carrier(robot: str, tmp_path: Path) -> None:
    own = Own(tmp_path, RAKED, ROWS)
    draw = {"goal": ["stands(tool,bed)", "-carries(helper,tool)"], "holding": 0.3}
    played = list(own.play(goal=None, draw=draw, limit=12, robots=[robot]))
    assert [record.outcome for record, _ in played] == ["achieved"] * 12


RAFTED = Domain(
    spots=("glade", "marsh"),
    paths=(("glade", "marsh"),),
    things=("acorn", "pebble"),
    raft="pebble",
    low=(),
    apart=False,
    grips=True,
    pushes=False,
    single=True,
)
PARTS = {
    "glade": ("glade_a", "glade_b"),
    "marsh": ("marsh_a", "marsh_b"),
    "acorn": ("acorn_a",),
    "pebble": ("pebble_a",),
}
PATCHES = Refined(RAFTED, ("spot", "thing"), PARTS, (("glade_b", "marsh_a"),))


def test_tests_are_about_what_their_sorts_allow(tmp_path: Path) -> None:
    own = Own(tmp_path, RAFTED.text, PATCHES.text)
    places = {"otter": "glade_a", "acorn_a": "glade_a", "pebble_a": "glade_b"}
    initial = [f"fine_rests({thing},{patch})" for thing, patch in places.items()]
    ((record, moments),) = own.play(
        goal=["tied(acorn,pebble)"], initial=initial, robots=["intentional"]
    )
    assert record.outcome == "achieved"
    asked = {m.decision.action for m in moments if m.decision.action.startswith("test_fine_tied")}
    assert asked == {"test_fine_tied(otter,acorn_a,pebble_a)"}


def test_a_goal_that_is_given_needs_none_that_is_drawn(tmp_path: Path) -> None:
    """The sorts of the goal that is drawn by default are none of this domain."""
    own = Own(tmp_path, RAKED, ROWS)
    played = list(own.play(goal=GOAL, limit=3, robots=["intentional"]))
    assert {tuple(record.goal) for record, _ in played} == {tuple(GOAL)}
    assert all(record.outcome == "achieved" for record, _ in played)


def test_a_thing_without_components_is_drawn_in_its_cell(tmp_path: Path) -> None:
    initial = [
        "fine_stands(tom,north_1)",
        "fine_stands(rake,north_2)",
        "fine_stands(spade,south_2)",
    ]
    file = Own(tmp_path, RAKED, ROWS).write(goal=GOAL, initial=initial)
    env = office_v0.env(config=file, render_mode="ansi")
    env.reset(seed=1)
    lines = str(env.render())
    assert "rake in north_2" in lines
    assert "spade in south_2" in lines
    picture = office_v0.env(config=file, render_mode="rgb_array")
    picture.reset(seed=1)
    assert picture.render().std() > 0


@pytest.mark.parametrize("command", ["translate", "check", "run"])
def test_what_nobody_can_test_is_refused_with_its_place(command: str, tmp_path: Path) -> None:
    untested, _, _ = ROWS.partition("tests\n")
    config = Own(tmp_path, RAKED, untested).write(goal=GOAL)
    arguments = [command, str(config.with_name("own.fine") if command == "translate" else config)]
    if command == "run":
        arguments += ["--out", str(tmp_path / "out")]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 2
    (line,) = done.stderr.splitlines()
    before, _, _ = untested.partition("stands.")
    column = len(before) - before.rfind("\n")
    assert f"own.fine:{before.count(chr(10)) + 1}:{column}: " in line
    assert "fine_stands" in line
