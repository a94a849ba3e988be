"""What a user finds out from Python and from a notebook, without the documents."""

import subprocess
import sys
from collections.abc import Callable
from html.parser import HTMLParser
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest

import testbed
from testbed import office_v0
from testbed.config import ConfigError, ExperimentConfig, Limits, load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

MAKERS = [office_v0.env, office_v0.raw_env, office_v0.parallel_env]
# Neither places nor things, and a name that is no HTML unless it is escaped.
LAMP = """
sorts
  lamp  = {left, right}.
  robot = {r}.
fluents
  inertial lit(lamp).
actions
  agent     light(robot, lamp).
  exogenous blow_out(lamp).
laws
  light(R, L) causes lit(L).
  blow_out(L) causes -lit(L).
sees
  R sees lit(L) if robot(R).
scenarios
  quiet: nothing.
"""


def _lamp(folder: Path) -> dict[str, Any]:
    path = folder / "lamp <script>.al"
    path.write_text(LAMP, encoding="utf-8")
    goal = ["lit(left)", "lit(right)"]
    return {"domain": str(path), "goal": goal, "scenarios": ["quiet"], "observability": {}}


class _Page(HTMLParser):
    """The elements and the text of a piece of HTML, in which every element is closed."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.text: list[str] = []
        self._open: list[str] = []
        self.feed(html)
        self.close()
        assert self._open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.text += [value or "" for _, value in attrs]
        if tag != "img":
            self._open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def test_the_version_is_that_of_the_distribution() -> None:
    assert testbed.__version__ == version("intention-testbed")
    with pytest.raises(AttributeError, match="__verson__"):
        _ = testbed.__verson__


@pytest.mark.parametrize(
    ("wrong", "meant"),
    [("confg", "config"), ("rendermode", "render_mode"), ("levl", "level"), ("gaol", "goal")],
)
@pytest.mark.parametrize("make", MAKERS)
def test_a_misspelt_keyword_is_told_what_was_meant(
    make: Callable[..., Any], wrong: str, meant: str
) -> None:
    with pytest.raises(ConfigError, match=f"^keyword argument: {wrong}: .*'{meant}'"):
        make(**{wrong: "x"})


@pytest.mark.parametrize("make", ["env", "raw_env", "parallel_env"])
def test_help_lists_every_key_of_a_configuration(make: str) -> None:
    program = f"from testbed import office_v0; help(office_v0.{make})"
    shown = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout
    keys = [line.strip().partition(":")[0] for line in shown.splitlines()]
    assert [key for key in keys if key in ExperimentConfig.model_fields] == list(
        ExperimentConfig.model_fields
    )
    (limits,) = [line for line in shown.splitlines() if line.strip().startswith("limits:")]
    assert all(name in limits for name in Limits.model_fields)


@pytest.mark.parametrize("make", MAKERS)
def test_an_environment_shows_itself_in_a_notebook(
    make: Callable[..., Any], tmp_path: Path
) -> None:
    env = make(**_lamp(tmp_path), max_cycles=7)
    assert _Page(env._repr_html_()).tags == ["p"]
    env.reset(seed=0)
    page = _Page(env._repr_html_())
    assert page.tags == ["figure", "img", "figcaption"]
    said = " ".join(page.text)
    for word in ("lamp <script>", "lit(left), lit(right)", "step 1 of 7", "data:image/png;base64,"):
        assert word in said


def test_a_trial_shows_itself_in_a_notebook(tmp_path: Path) -> None:
    overrides = [f"{key}={value}" for key, value in _lamp(tmp_path).items() if key != "goal"]
    given = ["goal=[lit(left),lit(right)]", "initial=[lit(left),-lit(right)]", "scenarios=[quiet]"]
    more = ["robots=[intentional]", "link=inprocess", "script=[{step: 2, action: blow_out(left)}]"]
    (spec,) = plan_trials(load_config("office", [*overrides, *given, *more]))
    result = play_trial(spec, InProcessRobot(make_robot))
    assert result.record.outcome == "achieved"
    html = result._repr_html_()
    assert html == result.record._repr_html_()
    page = _Page(html)
    assert page.tags.count("tr") == 1 + result.record.steps
    assert "script" not in page.tags
    said = " ".join(page.text)
    for word in (result.record.trial, "lamp <script>", "light(r,left)", "start(1)", "achieved"):
        assert word in said
    assert "blow_out(left), unseen" in said
