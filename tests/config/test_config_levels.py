"""Configurations of the fine resolution: levels, their own sizes and maps, and what is refused."""

import re
from pathlib import Path

import pytest

from asp.domains import LEVELS, LevelSize, level_text
from testbed.cli.loading import load
from testbed.config import ConfigError, level_size, load_config, refinements

VALID = """\
name: tiny
levels: [L1, wide]
level_sizes:
  wide: {rooms: 3, rows: 2, columns: 1, objects: [[1, 2], [1, 1]]}
limit: 2
draw: {holding: 0.5}
statistics: {fine_move: 0.85, test_fine_loc: 0.9}
adversary: {rate: 0.1, pace: abstract}
observability:
  fine_exo_move: {mode: always}
"""


def _file(folder: Path, text: str) -> Path:
    path = folder / "tiny.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def _refusal(folder: Path, text: str, *overrides: str) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        load_config(_file(folder, text), overrides)
    return [line.replace(f"{folder}/", "") for line in str(caught.value).splitlines()]


def test_levels_are_the_published_ones_and_those_of_a_size_of_ones_own(tmp_path: Path) -> None:
    config = load_config(_file(tmp_path, VALID))
    assert config.is_fine
    assert [name for name, _ in refinements(config)] == ["L1", "wide"]
    assert level_size(config, "L1") == LEVELS["L1"]
    assert level_size(config, "wide") == LevelSize(3, 2, 1, ((1, 2), (1, 1)))
    _, wide = dict(refinements(config)).popitem()
    assert wide.components["object1"] == ("object1_1", "object1_2")
    assert config.goal == ()


def test_a_goal_may_be_given_and_need_not(tmp_path: Path) -> None:
    given = load_config(_file(tmp_path, VALID), ["goal=[loc(object1,room2)]"])
    assert given.goal == ("loc(object1,room2)",)


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("[L1, wide]", "[L1, wid]", "tiny.yaml:2: levels[1]: unknown level 'wid'; did you mean"),
        ("[L1, wide]", "[L1, L1]", "tiny.yaml:2: levels[1]: 'L1' is listed twice"),
        (
            "  wide: {",
            "  L2: {rooms: 2, rows: 1, columns: 1, objects: [[1, 1]]}\n  wide: {",
            "tiny.yaml:4: level_sizes.L2: is a published level; give your own",
        ),
        ("rooms: 3", "rooms: 1", "tiny.yaml:4: level_sizes.wide.rooms: should be greater than"),
        ("[[1, 2], [1, 1]]", "[]", "tiny.yaml:4: level_sizes.wide.objects: should not be empty"),
        (
            "rows: 2",
            "rows: 2, row: 2",
            "tiny.yaml:4: level_sizes.wide.row: unknown key; did you mean",
        ),
        ("limit: 2\n", "", "tiny.yaml: limit: is missing; a level's trials are drawn"),
        ("name: tiny", "name: tiny\nscenarios: [1]", "tiny.yaml:2: scenarios: goes with no levels"),
        ("name: tiny", "name: tiny\ndomain: library", "tiny.yaml:2: domain: goes with no levels"),
        (
            "fine_move: 0",
            "fine_mov: 0",
            "tiny.yaml:7: statistics.fine_mov: no such action at this resolution; did you mean "
            "'fine_move'?",
        ),
        ("0.85", "1.5", "tiny.yaml:7: statistics.fine_move: should be less than or equal to 1"),
        (
            "  fine_exo_move",
            "  exo_move",
            "tiny.yaml:10: observability.exo_move: no such action at this resolution; did you "
            "mean 'fine_exo_move'?",
        ),
        ("{rate", "{strategy: triggers, rate", "tiny.yaml:8: adversary.strategy: triggers belong"),
        ("pace: abstract", "pace: abstrct", "tiny.yaml:8: adversary.pace: should be 'concrete'"),
        (
            "limit: 2",
            "limit: 2\ngoal: [loc(object1,room9)]",
            "tiny.yaml:6: goal[0]: 'room9' in loc(object1,room9) is not known there; did you mean",
        ),
        (
            "limit: 2",
            "limit: 2\ngoal: [loc(object1,room1), loc(object1,room2)]",
            "tiny.yaml:6: goal: no state has all of this: ",
        ),
        (
            "limit: 2",
            "limit: 2\ninitial: [fine_loc(rob1,room1)]",
            "tiny.yaml:6: initial[0]: 'room1' in fine_loc(rob1,room1) is not known there; did you",
        ),
        (
            "limit: 2",
            "limit: 2\nrepeats: 2",
            "tiny.yaml:6: repeats: goes with scenarios; at levels `limit` says how many",
        ),
        (
            "limit: 2",
            "limit: 2\ninitial: [fine_loc(rob1,room1_1)]",
            "tiny.yaml:6: initial: no such initial state: ",
        ),
        (
            "limit: 2",
            'limit: 2\nscript: [{step: 2, action: "exo_move(object1,room1)"}]',
            "tiny.yaml:6: script[0].action: no exogenous action 'exo_move'; did you mean "
            "'fine_exo_move'?",
        ),
        (
            "{holding: 0.5}",
            "{goal: [loc(objects,room)]}",
            "tiny.yaml:6: draw.goal[0]: 'objects' in loc(objects,room) is not known there; did you "
            "mean 'object'?",
        ),
        (
            "{holding: 0.5}",
            '{goal: [loc(object,room), "-loc(object,room)"]}',
            "tiny.yaml:6: draw.goal[1]: contradicts loc(object,room)",
        ),
        (
            "{holding: 0.5}",
            "{goal: [in_hand(object)]}",
            "tiny.yaml:6: draw.goal[0]: in_hand takes 2 arguments, as in in_hand(robot,object)",
        ),
        (
            "{holding: 0.5}",
            "{goal: [lok(object,room)]}",
            "tiny.yaml:6: draw.goal[0]: no fluent 'lok'; did you mean 'loc'?",
        ),
    ],
)
def test_a_mistake_gives_one_line_with_its_place_and_what_is_right(
    tmp_path: Path, old: str, new: str, line: str
) -> None:
    assert old in VALID
    (said,) = _refusal(tmp_path, VALID.replace(old, new, 1))
    assert said.startswith(line)


@pytest.mark.parametrize("key", ["statistics={fine_move: 0.5}"])
def test_what_belongs_to_levels_is_refused_without_them(key: str) -> None:
    with pytest.raises(ConfigError, match="levels"):
        load_config("office", [key])


@pytest.fixture
def own_map(tmp_path: Path) -> Path:
    """A configuration with a map of its own beside it."""
    coarse, fine = level_text(2, 1, 2, ((1, 1),))
    (tmp_path / "own.al").write_text(coarse, encoding="utf-8")
    (tmp_path / "flat.fine").write_text(fine, encoding="utf-8")
    return _file(tmp_path, "name: own\ndomain: own.al\nrefinement: flat.fine\nlimit: 1\n")


def test_a_map_of_ones_own_is_found_beside_and_is_called_as_its_file(own_map: Path) -> None:
    config = load_config(own_map)
    assert config.refinement == str(own_map.with_name("flat.fine"))
    assert [name for name, _ in refinements(config)] == ["flat"]


def test_a_mistake_in_a_map_is_told_with_its_place(own_map: Path) -> None:
    fine = own_map.with_name("flat.fine")
    text = fine.read_text(encoding="utf-8")
    fine.write_text(text.replace("fine_next_to(room1_1", "fine_next_to(rom1_1"), encoding="utf-8")
    lines = _refusal(own_map.parent, own_map.read_text(encoding="utf-8"))
    assert lines[0].startswith("flat.fine:")
    assert "rom1_1" in lines[0]


def test_a_domain_in_which_nobody_sees_anything_has_no_robot(own_map: Path) -> None:
    coarse = own_map.with_name("own.al")
    text = coarse.read_text(encoding="utf-8")
    blind = re.sub(r"^sees\n.*?(?=^% Execution units)", "", text, flags=re.MULTILINE | re.DOTALL)
    assert blind != text
    coarse.write_text(blind, encoding="utf-8")
    (line,) = _refusal(own_map.parent, own_map.read_text(encoding="utf-8"))
    assert line.startswith("tiny.yaml:2: domain: has no robot: nobody sees anything in it")


def test_a_map_that_is_not_there_is_one_line(own_map: Path) -> None:
    (line,) = _refusal(own_map.parent, own_map.read_text(encoding="utf-8"), "refinement=flt.fine")
    assert line.startswith("command line: refinement: ")
    assert "flt.fine" in line
    assert "office.fine" in line


def test_a_map_whose_name_no_file_can_have_is_one_line(own_map: Path) -> None:
    text = own_map.read_text(encoding="utf-8").replace("flat.fine", r'"flat\0.fine"')
    (line,) = _refusal(own_map.parent, text)
    assert line.startswith("tiny.yaml:3: refinement: ")


def test_levels_go_with_no_refinement(own_map: Path) -> None:
    (line,) = _refusal(own_map.parent, own_map.read_text(encoding="utf-8"), "levels=[L1]")
    assert line.startswith("command line: levels: goes with no refinement")


TABLETOP = Path(__file__).parents[1] / "asp" / "refinement"


def test_a_goal_that_was_written_for_other_levels_is_named_with_why() -> None:
    given = ["levels=[]", f"domain={TABLETOP / 'tabletop.al'}"]
    given += [f"refinement={TABLETOP / 'tabletop.fine'}", "statistics={}"]
    with pytest.raises(ConfigError) as caught:
        load_config("levels", given)
    (line,) = caught.value.lines
    assert line.startswith("command line: refinement: ")
    assert line.endswith("with this one give also draw.goal (no fluent 'loc')")
    own = load_config("levels", [*given, "draw.goal=[lies(block,zone)]"])
    assert own.draw.goal == ("lies(block,zone)",)
    with pytest.raises(ConfigError) as caught:
        load_config("levels", [*given[:-1], "draw.goal=[lies(block,zon)]"])
    why = "no such action at this resolution"
    assert [line.partition("also ")[2] for line in caught.value.lines] == [
        f"statistics ({why})",
        "",
    ]
    assert caught.value.lines[1].startswith("command line: draw.goal[0]: 'zon' in lies(block,zon) ")


def test_the_goal_by_default_may_not_fit_a_map(tmp_path: Path) -> None:
    files = f"domain: {TABLETOP / 'tabletop.al'}\nrefinement: {TABLETOP / 'tabletop.fine'}\n"
    (line,) = _refusal(tmp_path, f"name: tiny\n{files}limit: 1\n")
    assert line == (
        "tiny.yaml: draw.goal: is by default loc(object,room), which does not fit this domain: "
        "no fluent 'loc'; give a goal with its sorts: zone, arm, block, hue"
    )


def test_a_map_that_refines_another_domain_than_the_default_needs_that_one(own_map: Path) -> None:
    text = own_map.read_text(encoding="utf-8")
    (line,) = _refusal(own_map.parent, text.replace("domain: own.al\n", ""))
    assert line == (
        "tiny.yaml:2: refinement: flat.fine refines level, and the domain is office unless given; "
        "give domain: level"
    )


@pytest.mark.parametrize("given", ["levels: []", "draw: {holding: 0.5}", "statistics: {move: 1.0}"])
def test_where_the_goal_is_missing_it_may_be_the_levels_that_are(
    tmp_path: Path, given: str
) -> None:
    (line,) = _refusal(tmp_path, f"name: tiny\n{given}\n")
    assert line.startswith("tiny.yaml: goal: is missing; for example goal: ")
    assert line.endswith(
        "; or give levels, as in levels: [L1], or a refinement: there goals are drawn"
    )
    (line,) = _refusal(tmp_path, "name: tiny\n")
    assert "levels" not in line


@pytest.mark.parametrize(
    ("robot", "line"),
    [
        ("traditional", "'traditional' does not act at the fine resolution; robots that do: inten"),
        ("intentonal", "unknown robot 'intentonal'; did you mean 'intentional'?"),
    ],
)
def test_a_robot_is_one_that_acts_at_the_resolution(tmp_path: Path, robot: str, line: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load(_file(tmp_path, VALID), [f"robots=[intentional,{robot}]"])
    assert str(caught.value).startswith(f"command line: robots[1]: {line}")


def test_a_robot_of_the_fine_resolution_is_refused_without_levels() -> None:
    with pytest.raises(
        ConfigError, match="'intentional-nozoom' does not act at the coarse resolution"
    ):
        load("office", ["robots=[intentional-nozoom]"])
