"""The plan of a configuration: which trials, under which ids and seeds."""

from collections import Counter
from pathlib import Path

import pytest

from asp.language import read_domain
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from tests.asp.reasoning.branching import DIE


def _ids(*overrides: str, name: str = "office") -> list[str]:
    return [spec.trial for spec in plan_trials(load_config(name, overrides))]


def test_both_robots_of_a_pair_share_all_but_the_robot() -> None:
    specs = plan_trials(load_config("office", ["scenarios=[2, random]", "limit=3"]))
    assert len(specs) == 2 * 3 * 2
    assert len({spec.trial for spec in specs}) == len(specs)
    for one, other in zip(specs[::2], specs[1::2], strict=True):
        assert {one.robot, other.robot} == {"intentional", "traditional"}
        assert (one.pair, one.seed, one.initial) == (other.pair, other.seed, other.initial)
    assert len({spec.pair for spec in specs}) == 6
    assert len({spec.seed for spec in specs}) == 6


def test_each_robot_is_first_in_about_half_of_the_pairs() -> None:
    first = [spec.robot for spec in plan_trials(load_config("office", ["scenarios=[1]"]))[::2]]
    assert 70 < first.count("intentional") < 122  # of 192: p < 0.001 outside
    robots = "robots=[intentional,intentional-checking,traditional]"
    three = plan_trials(load_config("office", ["scenarios=[1]", robots]))
    assert {spec.robot for spec in three[::3]} == {spec.robot for spec in three}


def test_every_initial_state_is_there_where_no_limit_is() -> None:
    specs = plan_trials(load_config("office", ["scenarios=[1]", "robots=[intentional]"]))
    assert len({spec.initial for spec in specs}) == len(specs) == 192


def test_what_is_drawn_is_drawn_again_for_each_repeat() -> None:
    once = plan_trials(load_config("office", ["scenarios=[1,3]"]))
    thrice = plan_trials(load_config("office", ["scenarios=[1,3]", "repeats=3"]))
    played = Counter(spec.scenario for spec in thrice)
    assert (played["1"], played["3"]) == (2 * 192, 2 * 3 * 192)
    assert {spec.trial for spec in once} < {spec.trial for spec in thrice}
    assert len({spec.trial for spec in thrice}) == len(thrice)
    assert len({spec.seed for spec in thrice if spec.scenario == "3"}) == 3 * 192
    assert len({spec.initial for spec in thrice if spec.scenario == "3"}) == 192


@pytest.mark.parametrize(
    ("override", "pairs"),
    [
        ("scenarios=[2]", 192),
        ("adversary.rate=0.5", 3 * 192),
        ("adversary.rate=1.0", 192),
        ("observability.exo_move={mode: always, probability: 0.5}", 3 * 192),
        ("observability.exo_move={mode: always, false_reports: 0.1}", 3 * 192),
        ("scenario_settings={2: {repeats: 5}}", 192),
        ("scenario_settings={2: {repeats: 5}} adversary.rate=0.5", 5 * 192),
        ("limit=7 adversary.rate=0.5", 7),
    ],
)
def test_repeats_are_played_where_a_seed_makes_a_difference(override: str, pairs: int) -> None:
    parts = override.replace("} ", "}\n").replace("=7 ", "=7\n").split("\n")
    overrides = ["scenarios=[2]", "robots=[intentional]", "repeats=3", *parts]
    assert len(plan_trials(load_config("office", overrides))) == pairs


def test_a_script_is_played_once_from_each_state() -> None:
    script = 'script=[{step: 2, action: "exo_lock(library)"}]'
    specs = plan_trials(load_config("office", ["scenarios=[3]", "repeats=3", script, "limit=600"]))
    assert len({spec.pair for spec in specs}) == 192


def test_repeats_are_played_where_an_action_has_several_outcomes(tmp_path: Path) -> None:
    (tmp_path / "die.al").write_text(DIE, encoding="utf-8")
    path = tmp_path / "die.yaml"
    path.write_text(
        "name: die\ndomain: die.al\ngoal: [up(two)]\nscript: []\nrepeats: 3\n"
        "initial: [up(one), thrown]\nrobots: [intentional]\n",
        encoding="utf-8",
    )
    specs = plan_trials(load_config(path, []))
    assert len({spec.pair for spec in specs}) == len({spec.seed for spec in specs}) == 3


def test_a_smaller_limit_draws_a_part_of_the_repeats() -> None:
    few = _ids("scenarios=[3]", "repeats=4", "limit=10")
    many = _ids("scenarios=[3]", "repeats=4", "limit=300")
    assert set(few) < set(many)
    assert len(many) == 2 * 300


def test_the_published_comparison_has_about_four_thousand_pairs() -> None:
    specs = plan_trials(load_config("table1"))
    pairs = Counter(spec.scenario for spec in specs if spec.robot == "intentional")
    assert pairs == {"1": 192, "2": 192, "3": 768, "4": 768, "5": 192, "random": 1920}


def test_the_same_configuration_gives_the_same_plan() -> None:
    assert _ids("limit=4") == _ids("limit=4")


@pytest.mark.parametrize(
    "override",
    ["link=inprocess", "limits.answer_s=5.0", "name=other", "robots=[traditional,intentional]"],
)
def test_what_no_result_depends_on_changes_no_id(override: str) -> None:
    assert sorted(_ids("limit=2")) == sorted(_ids("limit=2", override))


@pytest.mark.parametrize(
    "override",
    [
        "seed=2",
        "goal_feedback=false",
        "knowledge=seen",
        "exogenous_while_thinking=true",
        "observability.exo_move.mode=always",
        "observability.exo_lock.probability=0.5",
        "observability.exo_lock.false_reports=0.5",
        "observability.exo_move.delay=1",
        "limits.steps=99",
        "limits.plan=29",
        "limits.decision_s=1.5",
        "adversary.rate=0.1",
        "goal=[loc(book1,kitchen)]",
        "script=[]",
    ],
)
def test_what_a_result_may_depend_on_changes_every_id(override: str) -> None:
    assert not set(_ids("scenarios=[1,2]")) & set(_ids("scenarios=[1,2]", override))


def test_a_smaller_limit_draws_a_part_of_a_larger_one() -> None:
    few, more, all_of_them = set(_ids("limit=5")), set(_ids("limit=20")), set(_ids())
    assert (len(few), len(more)) == (5 * 6 * 2, 20 * 6 * 2)
    assert few < more < all_of_them


def test_limits_draw_by_the_seed_and_for_each_scenario_anew() -> None:
    def drawn(*overrides: str) -> dict[str, list[tuple[str, ...]]]:
        specs = plan_trials(load_config("office", ["limit=10", "robots=[intentional]", *overrides]))
        return {name: [s.initial for s in specs if s.scenario == name] for name in ("1", "2")}

    assert drawn()["1"] != drawn()["2"]
    assert drawn()["1"] != drawn("seed=2")["1"]


def test_a_scenario_is_planned_with_its_own_settings() -> None:
    by_scenario = {s.scenario: s for s in plan_trials(load_config("quickstart"))}
    assert by_scenario["4"].setting.script == ((1, "exo_move(book2,kitchen)"),)
    assert "loc(book2,office1)" in by_scenario["4"].initial
    assert by_scenario["4"].setting.exogenous_while_thinking
    assert by_scenario["1"].setting.script is None
    assert "loc(book2,kitchen)" in by_scenario["1"].initial
    assert not by_scenario["1"].setting.exogenous_while_thinking


def test_a_domain_without_scenarios_is_played_undisturbed(tmp_path: Path) -> None:
    text = read_domain("office")[1]
    (tmp_path / "quiet.al").write_text(text[: text.index("\nscenarios\n")] + "\n", encoding="utf-8")
    path = tmp_path / "quiet.yaml"
    start = '["loc(rob1,kitchen)", "loc(book1,library)", "loc(book2,kitchen)"]'
    path.write_text(
        f"name: quiet\ndomain: quiet.al\ngoal: [loc(rob1,library)]\ninitial: {start}\n",
        encoding="utf-8",
    )
    specs = plan_trials(load_config(path))
    assert [(spec.scenario, spec.robot) for spec in specs] == [
        ("none", "intentional"),
        ("none", "traditional"),
    ]
    records = [play_trial(spec, InProcessRobot(make_robot)).record for spec in specs]
    assert [(record.outcome, record.exogenous) for record in records] == [("achieved", [])] * 2
