"""Adversaries of one's own: what they see, their options, and what becomes of their mistakes."""

import json
import os
import re
from pathlib import Path

import pytest

from testbed.cli.loading import load
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.registry import PATH_VARIABLE
from tests.cli.test_own_robots import ROOT, _distribution, _own, _refused, _run  # noqa: F401

WIND = """\
from dataclasses import dataclass


class Wind:
    '''Blows a pot away from where the robot carries one, at its n-th action.'''

    @dataclass(frozen=True)
    class Options:
        times: int
        spot: str = "floor"

    sees = {sees}

    def __init__(self, game, options):
        self._left, self._spot = options.times, options.spot
        self._goal = game.goal

    def reset(self, seed):
        pass

    def act(self, view):
        event = f"blow(rose,{{self._spot}})"
        seen = view.robot_action.startswith("carry") and "stands(rose,sill)" in view.state
        if not (seen and self._left):
            return "none"
        self._left -= 1
        return {answer}


class Calm:
    sees = ()

    def __init__(self, game, options): ...
    def reset(self, seed): ...
    def act(self, view):
        return "none"


class Silent(Calm):
    act = None


class Blind(Calm):
    sees = ("everything",)


class Untyped(Calm):
    Options = dict


class Hasty(Calm):
    def __init__(self, game): ...
"""
BOTH = ("state", "robot_action")
PLAY = [
    "beside/pots.yaml",
    "scenarios=null",
    "robots=[traditional]",
    "link=inprocess",
    "initial=['stands(fern,bench)','stands(rose,sill)']",
    "goal=['stands(fern,sill)','stands(rose,sill)']",
]


def _winds(name: str, answer: str = "event", sees: tuple[str, ...] = BOTH) -> None:
    text = WIND.format(answer=answer, sees=sees)
    Path(f"beside/{name}.py").write_text(text, encoding="utf-8")


def _played(adversary: str, options: str) -> TrialRecord:
    """The record of the one trial, played in this process."""
    given = [f"adversary.strategy={adversary}", f"adversary.options={options}"]
    (spec,) = plan_trials(load(PLAY[0], [*PLAY[1:], *given]))
    return play_trial(spec, InProcessRobot(make_robot)).record


def test_it_plays_in_the_workers_with_the_options_that_it_is_given() -> None:
    _winds("winds")
    given = ["adversary.strategy=winds:Wind", "adversary.options={times: 1, spot: bench}"]
    done = _run("run", *PLAY, *given, "--out", "run", "--quiet")
    assert done.returncode == 0, done.stderr
    (line,) = Path("run/trials.jsonl").read_text(encoding="utf-8").splitlines()
    record = json.loads(line)
    assert [event["action"] for event in record["exogenous"]] == ["blow(rose,bench)"]
    assert record["scenario"] == "winds:Wind"
    other = _played("winds:Wind", "{times: 1}")
    assert [event.action for event in other.exogenous] == ["blow(rose,floor)"]
    assert other.trial != record["trial"], "options are a part of what a trial is"
    assert _run("report", "run").returncode == 0


def test_one_of_an_installed_distribution_is_found_by_its_name(tmp_path: Path) -> None:
    """Its module lies where it is installed, not beside the configuration."""
    site = tmp_path / "site"
    _distribution(site, "pot-winds", "windy = winds_of_pots:Wind", "adversaries")
    module = WIND.format(answer="event", sees=BOTH)
    (site / "winds_of_pots.py").write_text(module, encoding="utf-8")
    path = os.pathsep.join([str(site), str(ROOT)])

    def run(command: str, strategy: str, options: str, *more: str) -> tuple[int, str]:
        given = [f"adversary.strategy={strategy}", f"adversary.options={options}", *more]
        done = _run(command, *PLAY, *given, PYTHONPATH=path)
        return done.returncode, done.stderr

    code, told = run("run", "windy", "{times: 1, spot: bench}", "--out", "run", "--quiet")
    assert code == 0, told
    (record,) = map(json.loads, Path("run/trials.jsonl").read_text("utf-8").splitlines())
    assert [event["action"] for event in record["exogenous"]] == ["blow(rose,bench)"]
    assert record["scenario"] == "windy"
    for strategy, options, parts in (
        ("wndy", "{times: 1}", ["adversary.strategy", "'windy'"]),
        ("windy", "{tims: 1}", ["adversary.options.tims", "'times'"]),
    ):
        code, told = run("check", strategy, options)
        (line,) = told.splitlines()
        assert code == 2
        assert all(part in line for part in parts), line


def test_it_plays_at_the_fine_resolution_too(monkeypatch: pytest.MonkeyPatch) -> None:
    _winds("calm")
    monkeypatch.setenv(PATH_VARIABLE, "beside")
    given = [
        "levels=[L1]",
        "limit=1",
        "robots=[intentional]",
        "adversary.strategy=calm:Calm",
        "adversary.rate=null",
    ]
    (spec,) = plan_trials(load("levels", given))
    record = play_trial(spec, InProcessRobot(make_robot)).record
    assert (record.outcome, record.exogenous) == ("achieved", [])


@pytest.mark.parametrize("sees", [(), ("state",), ("robot_action",)])
def test_what_it_does_not_declare_to_see_it_is_not_shown(sees: tuple[str, ...]) -> None:
    """Both are needed for an event here."""
    name = f"winds_{'_'.join(sees)}"
    _winds(name, sees=sees)
    assert _played(f"{name}:Wind", "{times: 1}").exogenous == []


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        ('"blow(rose,sill)"', "blow(rose,sill)"),
        ('"blow(rose,roof)"', "blow(rose,roof)"),
        ("7", "answered 7"),
        ("None", "answered None"),
        ("1 / 0", "ZeroDivisionError"),
    ],
)
def test_a_wrong_answer_ends_the_trial_and_is_told_in_its_record(answer: str, told: str) -> None:
    name = "wrong_" + re.sub(r"\W", "_", answer)
    _winds(name, answer)
    record = _played(f"{name}:Wind", "{times: 1}")
    assert (record.outcome, record.cause) == ("error", "testbed")
    assert told in str(record.reason)
    assert "\n" not in str(record.reason)


@pytest.mark.parametrize(
    ("adversary", "told"),
    [
        ("{strategy: 'winds:Wnd'}", ["adversary.strategy", "did you mean 'Wind'"]),
        ("{strategy: 'winds:Silent'}", ["adversary.strategy", "act"]),
        ("{strategy: 'winds:Blind'}", ["adversary.strategy", "sees"]),
        ("{strategy: 'winds:Untyped'}", ["adversary.strategy", "Options"]),
        ("{strategy: 'winds:Hasty'}", ["adversary.strategy", "2 arguments"]),
        ("{strategy: 'wind:Wind'}", ["adversary.strategy", "wind"]),
        ("{strategy: rando}", ["adversary.strategy", "did you mean 'random'"]),
        ("{strategy: 'winds:Wind'}", ["adversary.options", "times"]),
        ("{strategy: 'winds:Wind', options: {times: often}}", ["adversary.options.times", "int"]),
        ("{strategy: 'winds:Wind', options: {time: 1}}", ["adversary.options.time", "'times'"]),
        ("{strategy: 'winds:Wind', options: {times: 1}, rate: 0.5}", ["adversary.rate"]),
        ("{strategy: 'winds:Calm', options: {times: 1}}", ["adversary.options.times"]),
        ("{strategy: random, options: {rate: 0.5}}", ["adversary.options.rate", "adversary.rate"]),
        ("{options: {spot: sill}}", ["adversary.options.spot"]),
    ],
)
def test_each_mistake_is_one_line_with_its_key(adversary: str, told: list[str]) -> None:
    _winds("winds")
    line = _refused("check", *PLAY, f"adversary={adversary}")
    assert all(part in line for part in told), line
