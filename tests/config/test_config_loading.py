"""Configurations: what is composed, and what is refused with which line."""

from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

import asp
from asp.language import load_description
from testbed.cli.loading import load
from testbed.config import (
    AdversarySettings,
    ConfigError,
    ExperimentConfig,
    Limits,
    Observability,
    find_config,
    load_config,
)

pytestmark = pytest.mark.versions

VALID = """\
name: tiny
seed: 3
goal: ["loc(book1,library)"]
initial: ["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)"]
scenarios: [1, random]
scenario_settings:
  1: {goal: ["loc(book2,office1)"], script: []}
observability:
  exo_move: {mode: colocated, probability: 0.5}
limits:
  steps: 20
"""


def _file(folder: Path, text: str) -> Path:
    path = folder / "tiny.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def _refusal(
    folder: Path, text: str, *overrides: str, read: Callable[..., object] = load_config
) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        read(_file(folder, text), overrides)
    prefix = f"{folder / 'tiny.yaml'}"
    return [line.replace(prefix, "tiny.yaml") for line in str(caught.value).splitlines()]


def test_reads_what_the_file_says_and_fills_in_the_rest(tmp_path: Path) -> None:
    config = load_config(_file(tmp_path, VALID))
    assert (config.name, config.seed, config.domain) == ("tiny", 3, "office")
    assert config.scenarios == ("1", "random")
    assert config.robots == ("intentional", "traditional")
    assert (config.limits.steps, config.limits.plan) == (20, 30)
    assert config.observability["exo_move"].probability == 0.5
    assert config.goal_feedback is True
    assert config.exogenous_while_thinking is False
    assert config.limit is None


def test_scenarios_are_those_of_the_domain_unless_they_are_named(tmp_path: Path) -> None:
    start = "name: tiny\ngoal: [loc(book1,library)]\n"
    everything = load_config(_file(tmp_path, start)).scenarios
    assert everything == load_description("office").scenarios
    assert load_config(_file(tmp_path, start), ["script=[]"]).scenarios == ("script",)


def test_where_a_domain_has_no_scenarios_nothing_happens(tmp_path: Path) -> None:
    lamp = tmp_path / "lamp.al"
    lamp.write_text(LAMP.partition("scenarios")[0], encoding="utf-8")
    config = load_config(_file(tmp_path, f"name: tiny\ndomain: {lamp}\ngoal: [lit]\n"))
    assert (config.scenarios, config.settings("none").script) == (("none",), ())


def test_settings_of_a_scenario_are_its_own_where_it_has_them(tmp_path: Path) -> None:
    config = load_config(_file(tmp_path, VALID))
    assert config.settings("1").goal == ("loc(book2,office1)",)
    assert config.settings("1").script == ()
    assert config.settings("random").goal == ("loc(book1,library)",)
    assert config.settings("random").script is None
    assert config.settings("1").initial == config.settings("random").initial == config.initial


def test_overrides_reach_into_the_depth_and_win(tmp_path: Path) -> None:
    overrides = [
        "limits.plan=7",
        "robots=[intentional]",
        "scenario_settings.1.goal_feedback=false",
        "adversary.rate=0.2",
        "limit=5",
    ]
    config = load_config(_file(tmp_path, VALID), overrides)
    assert (config.limits.steps, config.limits.plan) == (20, 7)
    assert config.robots == ("intentional",)
    assert config.settings("1").goal_feedback is False
    assert config.settings("random").goal_feedback is True
    assert config.settings("1").goal == ("loc(book2,office1)",)
    assert (config.adversary.rate, config.limit) == (0.2, 5)


def test_a_tab_before_a_comment_does_no_harm(tmp_path: Path) -> None:
    assert load_config(_file(tmp_path, VALID.replace("seed: 3", "seed: 3\t# root"))).seed == 3


def test_literals_need_no_quotes_and_no_exact_spacing(tmp_path: Path) -> None:
    text = VALID.replace('["loc(book1,library)"]', '[loc(book1, library), "-locked( library )"]')
    config = load_config(_file(tmp_path, text), ["scenario_settings.1.goal=[loc(book2,kitchen)]"])
    assert config.goal == ("loc(book1,library)", "-locked(library)")
    assert config.settings("1").goal == ("loc(book2,kitchen)",)


@pytest.mark.parametrize("name", ["quickstart", "office", "table1"])
def test_packaged_configurations_are_found_by_name(name: str) -> None:
    assert load(name).name == name


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("seed: 3", "sed: 3", "tiny.yaml:2: sed: unknown key; did you mean 'seed'?"),
        ("steps: 20", "stps: 20", "tiny.yaml:11: limits.stps: unknown key; did you mean 'steps'?"),
        (
            "seed: 3",
            "seed: three",
            "tiny.yaml:2: seed: should be an integer, not 'three'",
        ),
        (
            "scenarios: [1, random]",
            "scenarios: 5",
            "tiny.yaml:5: scenarios: should be a list such as [5]",
        ),
        (
            "colocated",
            "colocatd",
            "tiny.yaml:9: observability.exo_move.mode: should be 'never', 'colocated' or "
            "'always', not 'colocatd'; did you mean 'colocated'?",
        ),
        (
            "0.5",
            "1.5",
            "tiny.yaml:9: observability.exo_move.probability: should be less than or equal "
            "to 1, not 1.5",
        ),
        (
            "exo_move:",
            "exo_mov:",
            "tiny.yaml:9: observability.exo_mov: no such exogenous action; "
            "did you mean 'exo_move'?",
        ),
        (
            "book1,library)",
            "bok1,library)",
            "tiny.yaml:3: goal[0]: 'bok1' in loc(bok1,library) is not known there; "
            "did you mean 'book1'?",
        ),
        (
            '["loc(book1,library)"]\n',
            "[]\n",
            'tiny.yaml:3: goal: should not be empty; for example goal: ["f(a,b)", "-g(a)"]',
        ),
        (
            "loc(book1,lib",
            "lok(book1,lib",
            "tiny.yaml:3: goal[0]: no fluent 'lok'; did you mean 'locked'?",
        ),
        (
            "loc(rob1,kitchen)",
            "loc(rob1,kitchn)",
            "tiny.yaml:4: initial[0]: 'kitchn' in loc(rob1,kitchn) is not known there; "
            "did you mean 'kitchen'?",
        ),
        (
            "loc(book1,library)",
            "locked(library,kitchen)",
            "tiny.yaml:3: goal[0]: locked takes 1 arguments, as in locked(library)",
        ),
        (
            "[1, random]",
            "[1, randm]",
            "tiny.yaml:5: scenarios[1]: unknown scenario 'randm'; did you mean 'random'?",
        ),
        (
            "[1, random]",
            "[1, 1]",
            "tiny.yaml:5: scenarios[1]: '1' is listed twice; keep one of the two",
        ),
        (
            "script: []",
            'script: [{step: 1, action: "exo_move(book2,kichen)"}]',
            "tiny.yaml:7: scenario_settings.1.script[0].action: 'kichen' in "
            "exo_move(book2,kichen) is not known there; did you mean 'kitchen'?",
        ),
        (
            "script: []",
            'script: [{step: 2, action: "exo_lock(library)"}, '
            '{step: 2, action: "exo_move(book2,kitchen)"}]',
            "tiny.yaml:7: scenario_settings.1.script[1].step: step 2 has an action already; "
            "one a step",
        ),
        (
            '"loc(book1,library)"]\ninitial',
            '"loc(book1,library)", "-loc(book1,library)"]\ninitial',
            "tiny.yaml:3: goal[1]: contradicts loc(book1,library); keep one of the two",
        ),
    ],
)
def test_a_mistake_gives_one_line_with_its_place_and_what_is_right(
    tmp_path: Path, old: str, new: str, line: str
) -> None:
    assert old in VALID
    assert _refusal(tmp_path, VALID.replace(old, new, 1)) == [line]


def test_an_unquoted_action_is_explained(tmp_path: Path) -> None:
    text = VALID.replace("script: []", "script: [{step: 1, action: exo_move(book2,kitchen)}]")
    (line,) = _refusal(tmp_path, text)
    assert line.startswith("tiny.yaml:7: scenario_settings.1.script[0].kitchen)")
    assert "quotes" in line


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
    (line,) = _refusal(tmp_path, VALID, f"initial={initial}")
    assert line.startswith("command line: initial: no such initial state: ")
    assert said in line


def test_every_mistake_is_reported_at_once(tmp_path: Path) -> None:
    text = VALID.replace("book1,library", "bok1,library").replace("[1, random]", "[7]")
    lines = _refusal(tmp_path, text, "robots=[intentinal]", read=load)
    places = [line.partition(":")[0] + line.partition(":")[2].partition(": ")[0] for line in lines]
    assert sorted(places) == ["command line robots[0]", "tiny.yaml3", "tiny.yaml5"]


@pytest.mark.parametrize(
    ("override", "line"),
    [
        ("limit", "command line: 'limit': an override is KEY=VALUE, e.g. limit=5"),
        ("limit=x", "command line: limit: should be an integer, not 'x'"),
        ("limit=0", "command line: limit: should be greater than or equal to 1, not 0"),
        ("seed=null", "command line: seed: should be an integer, not null"),
        ("limts.steps=2", "command line: limts: unknown key; did you mean 'limits'?"),
        ("seed.x=1", "command line: seed: should be an integer, not {'x': 1}"),
    ],
)
def test_a_wrong_override_is_said_to_be_one(tmp_path: Path, override: str, line: str) -> None:
    assert _refusal(tmp_path, VALID, override) == [line]


def test_the_place_of_overrides_is_named_as_the_caller_wants(tmp_path: Path) -> None:
    path = _file(tmp_path, VALID)
    for override in ("limit", "limit=x", "limit=[", "seeed=3", "goal=[loc(book1,attic)]"):
        with pytest.raises(ConfigError) as caught:
            load_config(path, [override], given_in="the caller")
        (line,) = str(caught.value).splitlines()
        assert line.startswith("the caller: ")
        assert "command line" not in line


LAMP = """\
sorts
  robot = {walle}.
fluents
  inertial lit.
actions
  agent     press(robot).
  exogenous cut.
laws
  press(R) causes lit.
  cut      causes -lit.
sees
  R sees lit if robot(R).
scenarios
  1: cut upon press(R) probability 0.
"""


def test_another_domain_over_a_file_needs_what_belongs_to_it(tmp_path: Path) -> None:
    lamp = tmp_path / "lamp.al"
    lamp.write_text(LAMP, encoding="utf-8")
    assert _refusal(tmp_path, VALID, f"domain={lamp}") == [
        "command line: domain: tiny.yaml is about another domain; with this one give also "
        "goal, initial, scenarios, scenario_settings, observability"
    ]
    given = [f"domain={lamp}", "scenarios=[1]", "scenario_settings={}", "goal=[lit]"]
    (line, *more) = _refusal(tmp_path, VALID, *given[:-1], "goal=[lid]")
    assert line.endswith("give also initial, observability")
    assert more == ["command line: goal[0]: no fluent 'lid'; did you mean 'lit'?"]
    config = load_config(_file(tmp_path, VALID), [*given, "observability={}", "initial=[lit]"])
    assert (config.observability, config.scenario_settings) == ({}, {})


def test_what_fits_another_domain_by_chance_is_named_with_what_does_not(tmp_path: Path) -> None:
    text = "name: tiny\ngoal: [loc(book1,library)]\nscenarios: [2]\n"
    (line,) = _refusal(tmp_path, text, "domain=library")
    assert line.endswith("with this one give also goal, scenarios")
    assert load_config(_file(tmp_path, text), ["domain=library", "scenarios=[random]"])


def test_a_domain_in_which_nobody_sees_anything_has_no_robot(tmp_path: Path) -> None:
    lamp = tmp_path / "lamp.al"
    text = f"name: tiny\ndomain: {lamp}\ngoal: [lit]\n"
    lamp.write_text(LAMP.replace("sees\n  R sees lit if robot(R).\n", ""), encoding="utf-8")
    (line,) = _refusal(tmp_path, text)
    assert line.startswith("tiny.yaml:2: domain: has no robot: nobody sees anything in it; ")
    (_, advice) = line.split("write for example: ")
    assert advice == "R sees f(X) if robot(R)."
    lamp.write_text(LAMP.replace("R sees lit", advice.partition(" if")[0].replace("f(X)", "lit")))
    assert load_config(_file(tmp_path, text)).goal == ("lit",)


@pytest.mark.parametrize(
    ("goal", "law"),
    [
        ("[loc(book1,library),loc(book1,kitchen)]", "-loc(book1,kitchen) if loc(book1,library)"),
        (
            "[in_hand(rob1,book1),loc(rob1,kitchen),loc(book1,library)]",
            "if loc(book1,library)",
        ),
        ("[in_hand(rob1,book1),in_hand(rob1,book2)]", "in_hand(rob1,book"),
    ],
)
def test_a_goal_that_no_state_has_is_refused_with_the_law(
    tmp_path: Path, goal: str, law: str
) -> None:
    (line,) = _refusal(tmp_path, VALID, f"goal={goal}")
    assert line.startswith("command line: goal: no state has all of this: ")
    assert "cannot be together: the constraint is " in line
    assert law in line
    (line,) = _refusal(tmp_path, VALID, f"scenario_settings.1.goal={goal}")
    assert line.startswith("command line: scenario_settings.1.goal: no state has")


def test_a_goal_that_no_state_has_is_refused_where_no_law_says_so_by_itself(
    tmp_path: Path,
) -> None:
    """That nothing else makes it safe is what `defined` says; and lit or not, the fuse is hot."""
    lamp = tmp_path / "lamp.al"
    fluents = "fluents\n  defined safe.\n  inertial hot.\n"
    laws = "laws\n  safe if -lit.\n  hot if lit.\n  hot if -lit.\n"
    text = LAMP.replace("fluents\n", fluents).replace("laws\n", laws)
    lamp.write_text(text, encoding="utf-8")
    given = [f"domain={lamp}", "scenarios=[1]", "scenario_settings={}", "observability={}"]

    def refusal(goal: str) -> list[str]:
        return _refusal(tmp_path, VALID, *given, "initial=[lit]", f"goal={goal}")

    prefix = "command line: goal: no state has all of this: "
    assert refusal("[safe,hot,lit]") == [prefix + "safe and lit cannot both hold"]
    assert refusal("[-hot]") == [prefix + "-hot cannot hold"]
    allowed = [*given, "initial=[lit,hot]", "goal=[-safe,lit]"]
    assert load_config(_file(tmp_path, VALID), allowed).goal == ("-safe", "lit")


@pytest.mark.parametrize(
    "text", ["- a\n- b\n", "name: [x\n", "name: x\nname: y\n", "goal: ${nothing}\n"]
)
def test_what_is_no_configuration_at_all_is_one_line(tmp_path: Path, text: str) -> None:
    (line,) = _refusal(tmp_path, text)
    assert line.startswith("tiny.yaml")


def test_missing_keys_are_named(tmp_path: Path) -> None:
    lines = _refusal(tmp_path, "")
    assert [line.split(";")[0] for line in lines] == [
        "tiny.yaml: name: is missing",
        "tiny.yaml: goal: is missing",
    ]


def test_a_file_that_is_not_there_suggests_the_nearest_packaged_one() -> None:
    with pytest.raises(
        ConfigError, match=r"^quikstart: no such file; did you mean 'quickstart'\?$"
    ):
        load_config("quikstart")


def test_a_domain_beside_the_configuration_is_found_from_anywhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "own.al").write_text(asp.load_description("office").source, encoding="utf-8")
    path = _file(tmp_path, VALID + "domain: own.al\n")
    monkeypatch.chdir("/")
    assert Path(load_config(path).domain) == (tmp_path / "own.al").resolve()


def test_a_mistake_in_the_domain_is_told_with_its_place(tmp_path: Path) -> None:
    (tmp_path / "own.al").write_text("sorts\n  room = {kitchen}\n", encoding="utf-8")
    lines = _refusal(tmp_path, VALID + "domain: own.al\n")
    assert all("own.al:" in line for line in lines)


def test_the_dump_of_a_configuration_is_the_configuration(tmp_path: Path) -> None:
    config = load_config(_file(tmp_path, VALID))
    again = ExperimentConfig.model_validate(config.model_dump(mode="json", exclude_none=True))
    assert again == config


AT_ONCE = 'script: [{step: 2, action: "exo_lock(library)"}, {step: 1, action: "exo_lock(library)"}]'
EARLY = (
    "at step 1 the robot 'intentional' does not act on the world yet, when nothing exogenous "
    "happens; give a later step, or exogenous_while_thinking: true"
)


def _loaded(folder: Path, text: str, *overrides: str) -> list[str]:
    """The lines of a refusal, where a robot only starts at step 1; none if it is accepted."""
    try:
        load(_file(folder, text), overrides)
    except ConfigError as error:
        return [line.rpartition("tiny.yaml")[2] for line in error.lines]
    return []


@pytest.mark.parametrize(
    ("overrides", "lines"),
    [
        (
            ["robots=[traditional,intentional]"],
            [f":7: scenario_settings.1.script[1].step: {EARLY}"],
        ),
        (["robots=[traditional]"], []),
        (["robots=[intentional]", "exogenous_while_thinking=true"], []),
        (["robots=[intentional]", "scenario_settings.1.exogenous_while_thinking=true"], []),
        (
            [
                "robots=[intentional]",
                "exogenous_while_thinking=true",
                "scenario_settings.1.exogenous_while_thinking=false",
            ],
            [f":7: scenario_settings.1.script[1].step: {EARLY}"],
        ),
        (["robots=[intentional]", "scenarios=[random]"], []),
    ],
)
def test_nothing_can_happen_at_step_1_beside_a_robot_that_waits_then(
    tmp_path: Path, overrides: list[str], lines: list[str]
) -> None:
    assert _loaded(tmp_path, VALID.replace("script: []", AT_ONCE), *overrides) == lines


@pytest.mark.parametrize("scenarios", ["scenarios: [1, 2, random]\n", ""])
def test_a_script_that_scenarios_share_is_refused_once(tmp_path: Path, scenarios: str) -> None:
    text = f"name: tiny\ngoal: [loc(book1,library)]\n{AT_ONCE}\nrobots: [intentional]\n{scenarios}"
    assert _loaded(tmp_path, text) == [f":3: script[1].step: {EARLY}"]


def test_the_office_lists_every_key_of_the_coarse_resolution() -> None:
    text = yaml.safe_load(find_config("office").read_text(encoding="utf-8"))
    everything = ExperimentConfig.model_fields.keys()
    assert everything - text.keys() == {"refinement", "levels", "level_sizes", "draw", "statistics"}
    assert AdversarySettings.model_fields.keys() - text["adversary"].keys() == {"pace"}
    assert Limits.model_fields.keys() == text["limits"].keys()
    for entry in text["observability"].values():
        assert Observability.model_fields.keys() == entry.keys()
