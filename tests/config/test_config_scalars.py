"""Values of a configuration: numbers, text, interpolations, and what YAML 1.1 takes them for."""

from itertools import pairwise
from pathlib import Path

import pytest
import yaml

from asp.language import Literal
from testbed.config import ConfigError, ExperimentConfig, Limits, load_config
from testbed.experiment.run_folder import read_config, write_config
from tests.config.tiny import LAMP

SWITCH = LAMP.partition("scenarios")[0]
SCRIPTED = "name: tiny\ndomain: switch.al\ngoal: [lit]\nscript: []\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "switch.al").write_text(SWITCH, encoding="utf-8")
    return tmp_path


def _load(folder: Path, more: str = "", *overrides: str) -> ExperimentConfig:
    path = folder / "tiny.yaml"
    path.write_text(SCRIPTED + more, encoding="utf-8")
    return load_config(path, overrides)


def _refusal(folder: Path, more: str, *overrides: str) -> str:
    with pytest.raises(ConfigError) as caught:
        _load(folder, more, *overrides)
    (line,) = caught.value.lines
    assert "\n" not in line
    return line


@pytest.mark.parametrize("override", [True, False])
@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("seed", "010"),
        ("seed", "1:30"),
        ("seed", "1_000"),
        ("seed", "0x10"),
        ("seed", "9223372036854775808"),
        ("seed", "9" * 5000),
        ("limit", ""),
        ("script", ""),
        ("limits", ""),
        ("repeats", "2147483648"),
        ("goal_feedback", "yes"),
        ("goal_feedback", "on"),
        ("name", "1.50"),
    ],
)
def test_a_value_of_doubtful_meaning_is_refused_with_its_key(
    folder: Path, key: str, text: str, override: bool
) -> None:
    if override:
        line = _refusal(folder, "", f"{key}={text}")
        assert line.startswith(f"command line: {key}: ")
    else:
        kept = [own for own in SCRIPTED.splitlines(True) if not own.startswith(f"{key}:")]
        path = folder / "own.yaml"
        path.write_text("".join([*kept, f"{key}: {text}\n"]), encoding="utf-8")
        with pytest.raises(ConfigError) as caught:
            load_config(path)
        (line,) = caught.value.lines
        assert line.startswith(f"{path}:{len(kept) + 1}: {key}: ")
    assert len(line) < 300 + len(str(folder))


@pytest.mark.parametrize("text", [".inf", ".nan", "1e12", "1e400", "0", "-1", "Infinity"])
@pytest.mark.parametrize("key", ["answer_s", "decision_s"])
def test_a_time_is_finite_and_no_longer_than_a_clock_can_measure(
    folder: Path, key: str, text: str
) -> None:
    line = _refusal(folder, f"limits:\n  {key}: {text}\n")
    assert line.startswith(f"{folder / 'tiny.yaml'}:6: limits.{key}: ")
    assert _refusal(folder, "", f"limits.{key}={text}").startswith(f"command line: limits.{key}: ")
    assert _load(folder, "", f"limits.{key}=1e6").limits.model_dump()[key] == 1_000_000.0


NAMES = ("no", "on", "01", "1:30", "2026-01-01", "0x10", "1_000", "+3", "y")


def test_a_name_is_the_text_that_stands_there_and_stays_it_in_the_run_folder(folder: Path) -> None:
    config = _load(folder, f"scenarios: [{', '.join(NAMES)}, 7, '1e3', 'null']\n")
    assert config.scenarios == (*NAMES, "7", "1e3", "null")
    write_config(folder / "run", config)
    assert read_config(folder / "run").scenarios == config.scenarios
    settings = _load(folder, "scenarios: [no]\nscenario_settings: {no: {repeats: 2}}\n")
    assert settings.settings("no").repeats == 2


@pytest.mark.parametrize(
    ("text", "value"), [("5", 5.0), ("5.", 5.0), (".5", 0.5), ("1e-3", 0.001), ("2.5E+2", 250.0)]
)
def test_numbers_in_decimal_are_what_they_are(folder: Path, text: str, value: float) -> None:
    assert _load(folder, f"limits: {{answer_s: {text}}}\n").limits.answer_s == value
    assert _load(folder, "", f"limits.answer_s={text}").limits.answer_s == value


REFUSED = object()


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("name", "run-${seed}", "run-4"),
        ("name", "${name_of_run}", REFUSED),
        ("limits", "{steps: 20, plan: '${limits.steps}'}", Limits(steps=20, plan=20)),
        ("limits", "{plan: '${limits.steps}'}", Limits(plan=100)),
        ("limit", "${limits.plan}", 30),
        ("seed", "${oc.env:TESTED_SEED}", 12),
        ("name", "${oc.env:TESTED_SEED}", "12"),
        ("seed", "${oc.env:TESTED_WORD}", REFUSED),
        ("seed", "${oc.env:TESTED_ABSENT}", REFUSED),
        ("goal_feedback", "${oc.env:TESTED_FLAG}", False),
        ("limit", "${oc.env:TESTED_NULL}", None),
        ("seed", "${seed}", REFUSED),
        ("goal", "${initial}", REFUSED),
    ],
)
def test_an_interpolation_stands_for_a_value_in_the_file_and_in_an_override(
    folder: Path, monkeypatch: pytest.MonkeyPatch, key: str, text: str, value: object
) -> None:
    for name, own in (("SEED", "12"), ("WORD", "x"), ("FLAG", "false"), ("NULL", "null")):
        monkeypatch.setenv(f"TESTED_{name}", own)
    path = folder / "own.yaml"
    given = {"name": "tiny", "domain": "switch.al", "goal": "[lit]", "script": "[]", "seed": "4"}

    def write(keys: dict[str, str]) -> None:
        path.write_text("".join(f"{k}: {v}\n" for k, v in keys.items()), encoding="utf-8")

    def found(*overrides: str) -> object:
        try:
            return getattr(load_config(path, overrides), key)
        except ConfigError as error:
            (line,) = error.lines
            assert f": {key}: " in line
            assert line.startswith("command line: " if overrides else f"{path}:")
            return REFUSED

    write(given | {key: text})
    assert found() == value
    write(given)
    assert found(f"{key}={text}") == value


def test_an_override_may_be_of_a_part_of_a_section(folder: Path) -> None:
    assert _load(folder, "", "limits.plan=${limits.steps}").limits.plan == 100
    assert _load(folder, "limits: {steps: 7}\n", "limits.plan=${limits.steps}").limits.plan == 7


def test_at_the_fine_resolution_an_interpolation_knows_its_number_of_steps() -> None:
    config = load_config("levels", ["limits=${nothing}", "limits={}", "seed=${limits.steps}"])
    assert config.seed == config.limits.steps == 5000


@pytest.mark.parametrize(
    "text",
    [
        "goal: " + "[" * 100 + "]" * 100,
        "goal: " + "[" * 100_000 + "]" * 100_000,
        "seed: 1\nseed: 2",
        "scenario_settings: {3: {}, '3': {}}",
        "seed: &own [*own]",
        "a: &a [1,1,1,1,1,1,1,1]\n"
        + "".join(f"{y}: &{y} [{','.join([f'*{x}'] * 8)}]\n" for x, y in pairwise("abcdef")),
        "? [a, b]\n: 1",
        "seed: !!python/name:os.system ''",
    ],
)
def test_a_document_that_no_configuration_can_be_is_refused_with_its_line(
    folder: Path, text: str
) -> None:
    path = folder / "own.yaml"
    path.write_text(f"name: own\n{text}\n", encoding="utf-8")
    with pytest.raises(ConfigError) as caught:
        load_config(path)
    (line,) = caught.value.lines
    assert line.startswith(f"{path}:")
    assert len(line) < 200 + len(str(path))


def test_a_literal_is_text_in_documents_of_users() -> None:
    literals = [Literal.parse("-at(left)"), Literal.parse("lit")]
    assert yaml.safe_load(yaml.safe_dump({"goal": literals})) == {"goal": ["-at(left)", "lit"]}
