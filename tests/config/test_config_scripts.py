"""Scripts of a configuration: how they are written, and when nothing can happen."""

from pathlib import Path

import pytest

from testbed.cli.loading import load
from testbed.config import ConfigError
from tests.config.tiny import VALID, file_of, refusal

pytestmark = pytest.mark.versions


def test_an_unquoted_action_is_explained(tmp_path: Path) -> None:
    text = VALID.replace("script: []", "script: [{step: 1, action: exo_move(book2,kitchen)}]")
    (line,) = refusal(tmp_path, text)
    assert line.startswith("tiny.yaml:7: scenario_settings.1.script[0].kitchen)")
    assert "quotes" in line


AT_ONCE = 'script: [{step: 2, action: "exo_lock(library)"}, {step: 1, action: "exo_lock(library)"}]'


EARLY = (
    "at step 1 the robot 'intentional' does not act on the world yet, when nothing exogenous "
    "happens; give a later step, or exogenous_while_thinking: true"
)


def _loaded(folder: Path, text: str, *overrides: str) -> list[str]:
    """The lines of a refusal, where a robot only starts at step 1; none if it is accepted."""
    try:
        load(file_of(folder, text), overrides)
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
