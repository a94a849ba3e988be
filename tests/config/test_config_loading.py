"""Configurations: how a file and overrides are composed, and what is no configuration at all."""

from pathlib import Path

import pytest
import yaml

from testbed.cli.loading import load
from testbed.config import (
    AdversarySettings,
    ConfigError,
    ExperimentConfig,
    Limits,
    Observability,
    RewardSettings,
    find_config,
    load_config,
)
from tests.config.tiny import VALID, file_of, refusal

pytestmark = pytest.mark.versions


def test_reads_what_the_file_says_and_fills_in_the_rest(tmp_path: Path) -> None:
    config = load_config(file_of(tmp_path, VALID))
    assert (config.name, config.seed, config.domain) == ("tiny", 3, "office")
    assert config.scenarios == ("1", "random")
    assert config.robots == ("intentional", "traditional")
    assert (config.limits.steps, config.limits.plan) == (20, 30)
    assert config.observability["exo_move"].probability == 0.5
    assert config.goal_feedback is True
    assert config.exogenous_while_thinking is False
    assert config.limit is None


def test_settings_of_a_scenario_are_its_own_where_it_has_them(tmp_path: Path) -> None:
    config = load_config(file_of(tmp_path, VALID))
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
    config = load_config(file_of(tmp_path, VALID), overrides)
    assert (config.limits.steps, config.limits.plan) == (20, 7)
    assert config.robots == ("intentional",)
    assert config.settings("1").goal_feedback is False
    assert config.settings("random").goal_feedback is True
    assert config.settings("1").goal == ("loc(book2,office1)",)
    assert (config.adversary.rate, config.limit) == (0.2, 5)


def test_a_tab_before_a_comment_does_no_harm(tmp_path: Path) -> None:
    assert load_config(file_of(tmp_path, VALID.replace("seed: 3", "seed: 3\t# root"))).seed == 3


def test_literals_need_no_quotes_and_no_exact_spacing(tmp_path: Path) -> None:
    text = VALID.replace('["loc(book1,library)"]', '[loc(book1, library), "-locked( library )"]')
    config = load_config(file_of(tmp_path, text), ["scenario_settings.1.goal=[loc(book2,kitchen)]"])
    assert config.goal == ("loc(book1,library)", "-locked(library)")
    assert config.settings("1").goal == ("loc(book2,kitchen)",)


@pytest.mark.parametrize("name", ["quickstart", "office", "table1"])
def test_packaged_configurations_are_found_by_name(name: str) -> None:
    assert load(name).name == name


def test_the_place_of_overrides_is_named_as_the_caller_wants(tmp_path: Path) -> None:
    path = file_of(tmp_path, VALID)
    for override in ("limit", "limit=x", "limit=[", "seeed=3", "goal=[loc(book1,attic)]"):
        with pytest.raises(ConfigError) as caught:
            load_config(path, [override], given_in="the caller")
        (line,) = str(caught.value).splitlines()
        assert line.startswith("the caller: ")
        assert "command line" not in line


@pytest.mark.parametrize(
    "text", ["- a\n- b\n", "name: [x\n", "name: x\nname: y\n", "goal: ${nothing}\n"]
)
def test_what_is_no_configuration_at_all_is_one_line(tmp_path: Path, text: str) -> None:
    (line,) = refusal(tmp_path, text)
    assert line.startswith("tiny.yaml")


def test_missing_keys_are_named(tmp_path: Path) -> None:
    lines = refusal(tmp_path, "")
    assert [line.split(";")[0] for line in lines] == [
        "tiny.yaml: name: is missing",
        "tiny.yaml: goal: is missing",
    ]


def test_a_file_that_is_not_there_suggests_the_nearest_packaged_one() -> None:
    with pytest.raises(
        ConfigError, match=r"^quikstart: no such file; did you mean 'quickstart'\?$"
    ):
        load_config("quikstart")


def test_the_dump_of_a_configuration_is_the_configuration(tmp_path: Path) -> None:
    config = load_config(file_of(tmp_path, VALID))
    again = ExperimentConfig.model_validate(config.model_dump(mode="json", exclude_none=True))
    assert again == config


def test_the_office_lists_every_key_of_the_coarse_resolution() -> None:
    text = yaml.safe_load(find_config("office").read_text(encoding="utf-8"))
    everything = ExperimentConfig.model_fields.keys()
    assert everything - text.keys() == {"refinement", "levels", "level_sizes", "draw", "statistics"}
    assert AdversarySettings.model_fields.keys() - text["adversary"].keys() == {"pace"}
    assert Limits.model_fields.keys() == text["limits"].keys()
    assert RewardSettings.model_fields.keys() == text["rewards"].keys()
    for entry in text["observability"].values():
        assert Observability.model_fields.keys() == entry.keys()
