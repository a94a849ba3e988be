"""The rules for the adversary at the fine resolution: what is fair is decided at the coarse one."""

from dataclasses import replace
from pathlib import Path

import pytest

from asp.refinement import load
from testbed import office_v0
from testbed.config import ConfigError
from testbed.environment import Core, EventRules, Rules, fine_core
from testbed.protocol import WAIT
from tests.experiment.gardens import GARDEN, ROWS
from tests.literals import parsed

RAKED = GARDEN.replace("OTHER", "rake")
STUCK = RAKED.replace("laws\n", "laws\n  impossible lift(H, T)  if stands(T, north).\n")
"""The same, where no tool can be lifted in the north."""
START = ["fine_stands(tom,north_1)", "fine_stands(spade,north_2)", "fine_stands(rake,north_1)"]
GOAL = ["stands(spade,south)"]


def _core(garden: str, goal: list[str] = GOAL, **rules: object) -> Core:
    """A game in the garden in which others act while the robot waits, too."""
    refinement = load(garden, "own.al", ROWS, "own.fine")
    given = Rules(parsed(goal), exogenous_while_thinking=True, adversary=EventRules(**rules))
    core = fine_core(refinement, given)
    core.reset(0, parsed(START))
    return core


def test_an_event_is_fair_that_brings_the_goal_into_reach() -> None:
    open_to_all, fair = _core(STUCK), _core(STUCK, fair=True)
    brought = {f"fine_stray(spade,south_{row})" for row in (1, 2)}
    assert brought < set(open_to_all.events(WAIT))
    assert set(fair.events(WAIT)) == {"none", *brought}
    assert "adversary.fair" in (fair.why_not(WAIT, "fine_stray(rake,south_1)") or "")


def test_where_all_can_be_undone_all_is_fair() -> None:
    open_to_all, fair = _core(RAKED), _core(RAKED, fair=True)
    assert len(fair.events(WAIT)) == 7
    assert fair.events(WAIT) == open_to_all.events(WAIT)


@pytest.mark.parametrize(
    ("row", "garden", "fair"),
    [("north_2", STUCK, True), ("south_1", STUCK, False), ("south_1", RAKED, True)],
)
def test_a_goal_of_the_fine_resolution_is_searched_there(row: str, garden: str, fair: bool) -> None:
    core = _core(garden, [f"fine_stands(spade,{row})"], fair=True)
    assert ("fine_stray(rake,north_2)" in core.events(WAIT)) is fair


def test_budget_cooldown_and_objects_are_counted() -> None:
    core = _core(RAKED, budget=2, cooldown=1, per_object={"tool": 1})
    spade, rake = parsed(["fine_stray(spade,south_1)", "fine_stray(rake,south_1)"])
    legal = []
    for event in (spade, "none", rake, "none"):
        legal.append({own.partition(",")[0] for own in core.events(WAIT)} - {"none"})
        core.advance(WAIT, event)
    both = {"fine_stray(spade", "fine_stray(rake"}
    assert legal == [both, set(), {"fine_stray(rake"}, set()]
    assert (core.left.budget, core.left.cooldown) == (0, 0)
    assert core.left.per_object == {"tool": {"rake": 0, "spade": 0}}


def test_the_adversary_is_rewarded_where_the_robot_fails_within_reach(tmp_path: Path) -> None:
    (tmp_path / "own.al").write_text(RAKED, encoding="utf-8")
    (tmp_path / "own.fine").write_text(ROWS, encoding="utf-8")
    text = f"name: own\ndomain: own.al\nrefinement: own.fine\nlimit: 1\ngoal: {GOAL}\n"
    (tmp_path / "own.yaml").write_text(f"{text}robots: [intentional]\ninitial: {START}\n")
    file = tmp_path / "own.yaml"
    env = office_v0.raw_env(file, max_cycles=2, rewards={"adversary": "fail"})
    env.reset(seed=0)
    for _ in range(4):
        env.step(0)
    assert env.rewards == {"robot_0": -1.0, "adversary_0": 1.0}
    for rewards in ({"adversary": "waste"}, {"adversary": "regret"}, {"shaping": 1.0}):
        with pytest.raises(ConfigError, match=f"rewards.{next(iter(rewards))}: "):
            office_v0.raw_env(file, rewards=rewards)


def test_a_sort_or_an_event_that_there_is_not_is_refused() -> None:
    core = _core(RAKED)
    for rules in (EventRules(per_object={"shed": 1}), EventRules(events=("stray",))):
        with pytest.raises(ValueError, match=r"shed|stray"):
            Core(core.world, replace(core.rules, adversary=rules), ())
