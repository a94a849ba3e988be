"""Which scenarios a configuration plays: those of a domain, of its own, or none."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from testbed import office_v0
from testbed.config import ConfigError, ExperimentConfig, load_config
from testbed.experiment.plan import plan_trials
from tests.greenhouse import GREENHOUSE, WINDY

HEAD = "name: pots\ngoal: ['stands(fern,sill)']\ndomain: "


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "calm.al").write_text(GREENHOUSE, encoding="utf-8")
    (tmp_path / "windy.al").write_text(WINDY, encoding="utf-8")
    return tmp_path


def _load(folder: Path, text: str, *overrides: str) -> ExperimentConfig:
    path = folder / "pots.yaml"
    path.write_text(HEAD + text, encoding="utf-8")
    return load_config(path, overrides)


def _refusal(folder: Path, text: str, *overrides: str) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        _load(folder, text, *overrides)
    return list(caught.value.lines)


LEFT_OUT = """windy.al
scenarios: [calm, gust]
scenario_settings:
  calm: {goal: ['stands(rose,sill)']}
  gust: {script: [{step: 2, action: 'blow(fern,nowhere)'}], initial: ['stands(fern,moon)']}
"""


def test_settings_of_scenarios_that_are_left_out_are_not_looked_at(folder: Path) -> None:
    assert len(_refusal(folder, LEFT_OUT)) == 2
    assert _load(folder, LEFT_OUT, "scenarios=[calm]").scenarios == ("calm",)
    assert _load(folder, LEFT_OUT.replace("[calm, gust]", "[calm]")).scenarios == ("calm",)
    (line,) = _refusal(folder, LEFT_OUT, "scenarios=[calm]", "scenario_settings.calm.goal=[x]")
    assert line.startswith("command line: scenario_settings.calm.goal[0]: ")


def test_one_of_the_scenarios_of_the_library_is_played_by_itself() -> None:
    config = load_config("library", ["scenarios=[lent]"])
    assert [spec.scenario for spec in plan_trials(config)] == ["lent", "lent"]


def test_settings_are_left_out_with_their_scenario_whatever_the_domain(folder: Path) -> None:
    """`random` is a scenario of table1, and has settings there; the greenhouse has none of it."""
    other = [f"domain={folder / 'calm.al'}", "goal=[stands(fern,sill)]", "observability={}"]
    assert load_config("table1", [*other, "scenarios=none"]).scenarios == ("none",)
    with pytest.raises(ConfigError) as caught:
        load_config("table1", [*other, "scenarios=none", "scenario_settings.windy.repeats=2"])
    (line,) = caught.value.lines
    assert line.startswith("command line: scenario_settings.windy: ")


def test_settings_without_a_scenario_are_a_mistake_where_none_was_left_out(folder: Path) -> None:
    text = "windy.al\nscenarios: [windy]\nscenario_settings:\n  wndy: {repeats: 3}\n"
    (line,) = _refusal(folder, text)
    assert line.startswith(f"{folder / 'pots.yaml'}:6: scenario_settings.wndy: ")
    assert "'windy'" in line


@pytest.mark.parametrize("text", ["none", "[]", "[none]"])
@pytest.mark.parametrize("domain", ["calm.al", "windy.al"])
def test_none_means_that_nothing_exogenous_happens(folder: Path, domain: str, text: str) -> None:
    for config in (
        _load(folder, f"{domain}\nscenarios: {text}\n"),
        _load(folder, domain + "\nscenarios: [windy]\n", f"scenarios={text}"),
    ):
        assert config.scenarios == ("none",)
        assert {spec.setting.script for spec in plan_trials(config)} == {()}


def test_null_means_what_there_is_in_the_domain(folder: Path) -> None:
    assert _load(folder, "windy.al\nscenarios: null\n").scenarios == ("calm", "windy")
    assert _load(folder, "calm.al\nscenarios: null\n").scenarios == ("none",)


def test_a_scenario_called_none_is_one_if_the_domain_has_it(folder: Path) -> None:
    own = WINDY.replace("calm: nothing", "none: blow(P, S) upon any drawing P")
    (folder / "windy.al").write_text(own, encoding="utf-8")
    config = _load(folder, "windy.al\nscenarios: [none]\n")
    assert {spec.setting.script for spec in plan_trials(config)} == {None}


def test_a_domain_without_scenarios_says_what_can_be_played_in_it(folder: Path) -> None:
    (line,) = _refusal(folder, "calm.al\nscenarios: [1]\n")
    assert line.startswith(f"{folder / 'pots.yaml'}:4: scenarios[0]: ")
    assert "scenarios: none" in line
    assert "adversary.strategy: random" in line


def test_random_events_are_a_scenario_of_their_own_or_take_the_place_of_triggers(
    folder: Path,
) -> None:
    drawn = "\nadversary: {strategy: random}\n"
    assert _load(folder, "calm.al" + drawn).scenarios == ("random",)
    assert _load(folder, "windy.al" + drawn).scenarios == ("random",)
    named = _load(folder, "windy.al" + drawn, "scenarios=[calm, gusty]")
    assert named.scenarios == ("calm", "gusty")
    with_script = _load(folder, "windy.al" + drawn, "script=[]")
    assert with_script.scenarios == ("script",)


@pytest.mark.parametrize("scenarios", ["none", None, [], ["none"]])
def test_an_environment_of_another_domain_needs_what_its_refusal_names(
    folder: Path, scenarios: Any
) -> None:
    given: dict[str, Any] = {"domain": str(folder / "calm.al"), "goal": ["stands(fern,sill)"]}
    with pytest.raises(ConfigError) as caught:
        office_v0.env(**given)
    assert _named(caught.value.lines) == {"scenarios", "observability"}
    env = office_v0.env(**given, scenarios=scenarios, observability={})
    env.reset(seed=1)
    assert "blow(fern,sill)" in env.unwrapped.core.adversary_actions  # type: ignore[attr-defined]


def _named(lines: Sequence[str]) -> set[str]:
    """The keys that a refusal wants."""
    (line,) = lines
    return {key for key in ("goal", "scenarios", "observability", "script") if key in line}
