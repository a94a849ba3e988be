"""Goals and initial states of a configuration that the laws of its domain forbid."""

from collections.abc import Callable
from pathlib import Path

import pytest

from testbed import office_v0
from testbed.config import load_config
from tests.config.tiny import LAMP, VALID, file_of, refusal
from tests.environment.coarse import FERRY
from tests.games import HARBOUR
from tests.greenhouse import GREENHOUSE

pytestmark = pytest.mark.versions


@pytest.mark.parametrize(
    ("initial", "said"),
    [
        ("[loc(rob1,kitchen),loc(book1,kitchen)]", "an initial state needs loc(book2,"),
        (
            "[loc(rob1,kitchen),in_hand(rob1,book1),loc(book1,office1),loc(book2,kitchen)]",
            "cannot be together",
        ),
        (
            "[loc(rob1,kitchen),loc(rob1,office2),loc(book1,kitchen),loc(book2,kitchen)]",
            "cannot be together",
        ),
    ],
)
def test_a_forbidden_initial_state_names_its_key_and_the_law(
    tmp_path: Path, initial: str, said: str
) -> None:
    (line,) = refusal(tmp_path, VALID, f"initial={initial}")
    assert line.startswith("command line: initial: no such initial state: ")
    assert said in line


@pytest.mark.parametrize(
    ("goal", "law"),
    [
        ("[loc(book1,library),loc(book1,kitchen)]", "-loc(book1,kitchen) if loc(book1,library)"),
        ("[in_hand(rob1,book1),loc(rob1,kitchen),loc(book1,library)]", "if loc(book1,library)"),
        ("[in_hand(rob1,book1),in_hand(rob1,book2)]", "in_hand(rob1,book"),
    ],
)
def test_a_goal_that_no_state_has_is_refused_with_the_law(
    tmp_path: Path, goal: str, law: str
) -> None:
    (line,) = refusal(tmp_path, VALID, f"goal={goal}")
    assert line.startswith("command line: goal: no state has all of this: ")
    assert "cannot be together: the constraint is " in line
    assert law in line
    (line,) = refusal(tmp_path, VALID, f"scenario_settings.1.goal={goal}")
    assert line.startswith("command line: scenario_settings.1.goal: no state has")


def test_a_goal_that_no_state_has_is_refused_where_no_law_says_so_by_itself(tmp_path: Path) -> None:
    """That nothing else makes it safe is what `defined` says; and lit or not, the fuse is hot."""
    lamp = tmp_path / "lamp.al"
    fluents = "fluents\n  defined safe.\n  inertial hot.\n"
    laws = "laws\n  safe if -lit.\n  hot if lit.\n  hot if -lit.\n"
    text = LAMP.replace("fluents\n", fluents).replace("laws\n", laws)
    lamp.write_text(text, encoding="utf-8")
    given = [f"domain={lamp}", "scenarios=[1]", "scenario_settings={}", "observability={}"]

    def refused(goal: str) -> list[str]:
        return refusal(tmp_path, VALID, *given, "initial=[lit]", f"goal={goal}")

    prefix = "command line: goal: no state has all of this: "
    assert refused("[safe,hot,lit]") == [prefix + "safe and lit cannot both hold"]
    assert refused("[-hot]") == [prefix + "-hot cannot hold"]
    allowed = [*given, "initial=[lit,hot]", "goal=[-safe,lit]"]
    assert load_config(file_of(tmp_path, VALID), allowed).goal == ("-safe", "lit")


NOWHERE = {
    "pots": (GREENHOUSE, "-stands(rose,B).", "-stands(rose,sill)"),
    "ferry": (FERRY, "-moored(cabbage,B) if bank(B).", "moored(goat,island)"),
    "harbour": (HARBOUR, "-stands(mate,B) if berth(B).", "lies(silk,west)"),
}
"""Domains, laws that leave no state in which each thing is somewhere, and goals that remain."""


@pytest.mark.parametrize("name", NOWHERE)
@pytest.mark.parametrize("read", [load_config, office_v0.env])
def test_a_domain_in_which_no_game_can_begin_is_refused(
    tmp_path: Path, name: str, read: Callable[..., object]
) -> None:
    text, law, goal = NOWHERE[name]
    config = f"name: tiny\ndomain: {name}.al\ngoal: ['{goal}']\n"
    domain = tmp_path / f"{name}.al"
    domain.write_text(text, encoding="utf-8")
    read(file_of(tmp_path, config))
    domain.write_text(text.replace("laws\n", f"laws\n  {law}\n"), encoding="utf-8")
    (line,) = refusal(tmp_path, config, read=lambda file, _: read(file))
    assert line.startswith("tiny.yaml:2: domain: ")
