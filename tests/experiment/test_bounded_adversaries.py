"""Trials under the rules for the adversary: random events, triggers and scripts keep them alike."""

import json
from collections import Counter
from dataclasses import fields
from itertools import pairwise
from pathlib import Path
from typing import Any

import msgspec
import pytest
from typer.testing import CliRunner, Result

from asp import parse_description
from testbed.cli import app
from testbed.config import load_config
from testbed.environment import EventRules
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.runner import run
from testbed.experiment.specs import Setting
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from tests.games import DOMAINS, config_of
from tests.greenhouse import WINDY

RANDOM = {"strategy": "random", "rate": 1.0}
PLAYED = {"robots": ["traditional"], "link": "inprocess", "limits": {"steps": 20}}


def _trials(file: Path) -> list[TrialRecord]:
    specs = plan_trials(load_config(str(file)))
    return [play_trial(spec, InProcessRobot(make_robot)).record for spec in specs]


def _bounded(folder: Path, name: str, rules: dict[str, Any]) -> list[TrialRecord]:
    """Trials against random events at every step, as far as the rules allow."""
    keys = {**PLAYED, "repeats": 6, "exogenous_while_thinking": True}
    records = _trials(config_of(folder, name, **keys, adversary={**RANDOM, **rules}))
    assert all(own.outcome not in ("error", "robot_lost") for own in records)
    return records


@pytest.mark.parametrize("name", DOMAINS)
def test_random_events_keep_the_budget_and_the_cooldown(name: str, tmp_path: Path) -> None:
    free, once, rarely = (
        _bounded(tmp_path, name, rules) for rules in ({}, {"budget": 1}, {"cooldown": 1})
    )
    assert 1 in _gaps(free)
    assert {len(own.exogenous) for own in once} == {1}
    assert all(own.exogenous for own in rarely)
    assert 1 not in _gaps(rarely)
    conditions = [own.condition for own in (*once, *rarely)]
    assert {(c.budget, c.cooldown) for c in conditions if c} == {(1, 0), (None, 1)}


def _gaps(records: list[TrialRecord]) -> set[int]:
    """By how many steps events follow each other."""
    pairs = (pair for record in records for pair in pairwise(record.exogenous))
    return {later.step - earlier.step for earlier, later in pairs}


@pytest.mark.parametrize("name", DOMAINS)
def test_random_events_name_each_object_as_often_as_they_may(name: str, tmp_path: Path) -> None:
    bounds, most = DOMAINS[name].per_object, 0
    domain = parse_description(DOMAINS[name].text)
    for record in _bounded(tmp_path, name, {"per_object": bounds}):
        named = Counter(part for event in record.exogenous for part in event.action.arguments)
        for sort, number in bounds.items():
            assert all(named[own] <= number for own in domain.sorts[sort])
        most = max([most, *named.values()])
    assert most


@pytest.mark.parametrize("name", ["harbour", "lanterns"])  # actions have one outcome each
def test_fair_events_leave_the_goal_within_reach(name: str, tmp_path: Path) -> None:
    assert any(own.in_reach is False for own in _bounded(tmp_path, name, {}))
    for record in _bounded(tmp_path, name, {"fair": True}):
        assert record.exogenous
        assert record.achieved or record.in_reach


def test_only_the_given_events_are_used(tmp_path: Path) -> None:
    for events in (["gust"], ["crack(green)", "gust(red)"], []):
        records = _bounded(tmp_path, "lanterns", {"events": events})
        used = {own.action for record in records for own in record.exogenous}
        assert all(own in events or own.name in events for own in used)
        assert bool(used) is bool(events)


def _scripted(folder: Path, policy: str) -> TrialRecord:
    """Two events of a script, where one is allowed."""
    script = [{"step": 1, "action": "gust(green)"}, {"step": 2, "action": "crack(green)"}]
    keys = {"script": script, "script_policy": policy, "exogenous_while_thinking": True}
    file = config_of(folder, "lanterns", **{**PLAYED, **keys, "adversary": {"budget": 1}})
    (record,) = _trials(file)
    return record


def test_an_entry_of_a_script_that_the_rules_refuse_is_rejected_with_the_reason(
    tmp_path: Path,
) -> None:
    record = _scripted(tmp_path, "skip")
    assert [(own.step, own.action) for own in record.exogenous] == [(1, "gust(green)")]
    ((step, action, why),) = [(r.step, r.action, r.reason) for r in record.rejected]
    assert (step, action) == (2, "crack(green)")
    assert "adversary.budget" in why


def test_or_ends_the_trial_with_the_reason(tmp_path: Path) -> None:
    record = _scripted(tmp_path, "error")
    assert (record.outcome, record.cause) == ("error", "testbed")
    assert "adversary.budget" in (record.reason or "")


def test_triggers_fire_only_what_the_rules_allow(tmp_path: Path) -> None:
    (tmp_path / "pots.al").write_text(WINDY, encoding="utf-8")
    given = {
        "name": "pots",
        "domain": "pots.al",
        "goal": ["stands(fern,sill)", "stands(rose,sill)"],
        "initial": ["stands(fern,floor)", "stands(rose,floor)"],
        "scenarios": ["windy"],
        **PLAYED,
    }
    seen = []
    for rules in ({}, {"events": ["blow(rose,bench)"]}, {"budget": 0}):
        (tmp_path / "pots.yaml").write_text(json.dumps({**given, "adversary": rules}))
        seen.append({own.action for r in _trials(tmp_path / "pots.yaml") for own in r.exogenous})
    assert seen[0]
    assert seen[1] <= {"blow(rose,bench)"}
    assert seen[2] == set()


GREEDY = """\
import json
from itertools import pairwise
from pathlib import Path


class Impatient:
    '''Acts as soon as it may, and writes down what was left to it.'''

    sees = ()

    def __init__(self, game, options):
        self._events, self._rules, self._told = game.exogenous_actions, game.rules, []

    def reset(self, seed):
        pass

    def act(self, view):
        self._told.append([view.left.budget, view.left.cooldown])
        told = {"left": self._told, "cost": self._rules.cost, "events": list(self._events)}
        Path(__file__).with_suffix(".json").write_text(json.dumps(told))
        return next((event for event in self._events if event in view.legal), "none")


class Defiant(Impatient):
    def act(self, view):
        return self._events[-view.step]
"""


def _own(folder: Path, name: str, event: str) -> Path:
    (folder / "impatient.py").write_text(GREEDY, encoding="utf-8")
    rules = {"strategy": f"impatient:{name}", "budget": 2, "cooldown": 1, "cost": 0.5}
    own = {"events": [event], **rules}
    keys = {**PLAYED, "exogenous_while_thinking": True, "adversary": own}
    return config_of(folder, "lanterns", **keys)


@pytest.fixture
def _found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Modules are found beside the configuration."""
    monkeypatch.syspath_prepend(tmp_path)


@pytest.mark.usefixtures("_found")
def test_a_strategy_sees_what_is_left_to_it(tmp_path: Path) -> None:
    (record,) = _trials(_own(tmp_path, "Impatient", "gust"))
    told = json.loads((tmp_path / "impatient.json").read_text("utf-8"))
    assert told["left"][:4] == [[2, 0], [1, 1], [1, 0], [0, 1]][: len(told["left"])]
    assert len(told["left"]) >= 2
    assert told["cost"] == 0.5
    assert set(told["events"]) == {f"gust({own})" for own in ("red", "green", "blue")}
    assert len(record.exogenous) <= 2


@pytest.mark.usefixtures("_found")
def test_a_strategy_that_breaks_the_rules_ends_the_trial(tmp_path: Path) -> None:
    (record,) = _trials(_own(tmp_path, "Defiant", "crack"))
    assert (record.outcome, record.cause) == ("error", "testbed")
    assert "adversary.cooldown" in (record.reason or "")
    assert [own.step for own in record.exogenous] == [1]


def _call(*arguments: str | Path) -> Result:
    return CliRunner().invoke(app, [str(part) for part in arguments])


def test_the_rules_are_swept_and_each_trial_replays_under_its_own(tmp_path: Path) -> None:
    grid = {"adversary.budget": [0, 2], "adversary.fair": [False, True]}
    keys = {**PLAYED, "exogenous_while_thinking": True, "sweep": {"grid": grid}}
    rules = {**RANDOM, "cooldown": 1, "per_object": {"crate": 3}, "events": ["silt", "drift"]}
    file = config_of(tmp_path, "harbour", **keys, adversary=rules)
    run(load_config(str(file)), tmp_path / "run", workers=0)
    lines = (tmp_path / "run" / "trials.jsonl").read_text("utf-8").splitlines()
    records = [json.loads(line) for line in lines]
    assert len(records) == 4
    told = {(r["condition"].get("budget"), r["condition"].get("fair", False)) for r in records}
    assert told == {(0, False), (0, True), (2, False), (2, True)}
    for record in records:
        assert len(record["exogenous"]) <= record["condition"]["budget"]
        assert record["condition"]["per_object"] == {"crate": 3}
        assert record["condition"]["events"] == ["silt", "drift"]
        row = tmp_path / f"{record['trial']}.json"
        asked = ("replay", tmp_path / "run", "--trial", record["trial"], "--row", "-o", row)
        assert _call(*asked).exit_code == 0
        replayed = _call("replay", row)
        assert replayed.exit_code == 0, replayed.output
        assert replayed.stdout.splitlines()[-1] == "as recorded"


def test_trials_without_rules_are_the_same_trials_as_ever(tmp_path: Path) -> None:
    plain = plan_trials(load_config(str(config_of(tmp_path, "harbour", **PLAYED))))
    rules = {"budget": None, "per_object": {}, "cooldown": 0, "cost": 0.0, "fair": False}
    rewards = {"adversary": "fail", "step": 0.5}
    file = config_of(tmp_path, "harbour", **PLAYED, adversary=rules, rewards=rewards)
    assert [s.trial for s in plan_trials(load_config(str(file)))] == [s.trial for s in plain]
    # The id is of what is not as by default: of older trials it is without these keys.
    by_default = {own.name: own.default for own in msgspec.structs.fields(Setting)}
    for own in fields(EventRules):
        assert getattr(plain[0].setting, own.name) == by_default[own.name]
    other = config_of(tmp_path, "harbour", **PLAYED, adversary={"budget": 1})
    assert {s.trial for s in plan_trials(load_config(str(other)))}.isdisjoint(
        s.trial for s in plain
    )


@pytest.mark.parametrize(
    ("override", "key", "told"),
    [
        ("adversary.budget=-1", "adversary.budget", "0"),
        ("adversary.cooldown=-1", "adversary.cooldown", "0"),
        ("adversary.cost=-0.5", "adversary.cost", "0"),
        ("adversary.per_object={crate: -1}", "adversary.per_object.crate", "0"),
        ("adversary.per_object={crat: 1}", "adversary.per_object.crat", "crate"),
        ("adversary.events=[drfit]", "adversary.events[0]", "drift"),
        ("adversary.events=[drift, sail]", "adversary.events[1]", "silt"),
        ("adversary.events=['drift(silk,mate)']", "adversary.events[0]", "mate"),
        ("adversary.events=['-silt(west)']", "adversary.events[0]", "silt"),
        ("adversary.events=[silt, silt]", "adversary.events[1]", "silt"),
        (
            "adversary={strategy: random, events: [drift], options: {mix: {drift: 1, silt: 1}}}",
            "adversary.options.mix",
            "silt",
        ),
        ("adversary.fair=yes", "adversary.fair", "true or false"),
        ("rewards.adversary=wast", "rewards.adversary", "waste"),
        ("rewards.robot=goals", "rewards.robot", "goal"),
        ("rewards.step=-1", "rewards.step", "0"),
        ("rewards.shaping=2e9", "rewards.shaping", "1000000000"),
        ("rewards.discount=0", "rewards.discount", "0"),
        ("sweep={grid: {rewards.step: [0, 1]}}", "sweep", "rewards.step"),
    ],
)
def test_what_cannot_be_is_refused(override: str, key: str, told: str, tmp_path: Path) -> None:
    done = _call("check", config_of(tmp_path, "harbour"), override)
    assert done.exit_code == 2
    (line,) = done.stderr.splitlines()
    assert line.startswith(f"command line: {key}: ")
    assert told in line.partition(f"{key}: ")[2]


SCRIPT = "[{step: 3, action: silt(west)}, {at_action: 2, action: 'drift(silk,dock)'}]"


@pytest.mark.parametrize(
    ("rules", "key"),
    [("{events: [drift]}", "[0].action"), ("{events: [silt, 'drift(silk,east)']}", "[1].action")],
)
@pytest.mark.parametrize("place", ["script", "scenario_settings.told.script"])
def test_a_script_that_the_rules_never_allow_is_refused(
    place: str, rules: str, key: str, tmp_path: Path
) -> None:
    file, given = config_of(tmp_path, "harbour", scenarios=["told"]), f"{place}={SCRIPT}"
    allowed = ("adversary={events: [drift, silt], budget: 2}", f"adversary={rules}")
    assert _call("check", file, given, "script=[]", allowed[0]).exit_code == 0
    assert _call("check", file, given, allowed[1], "script_policy=skip").exit_code == 0
    done = _call("check", file, given, allowed[1])
    (line,) = done.stderr.splitlines()
    assert done.exit_code == 2
    assert line.startswith(f"command line: {place}{key}: ")
