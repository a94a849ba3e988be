"""In how many decisions a robot lives under an explanation that is not proved to be smallest."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import FINISH, Capabilities, Decision, Percept, Task, Trace

LOCKER = """
% A courier with a parcel; others may move it while nobody looks.
sorts
  place   = {dock, hall, loft}.
  courier = {pia}.
  parcel  = {crate}.
  thing   = courier + parcel.
statics
  beside(place, place).
fluents
  inertial at(thing, place).
  inertial has(courier, parcel).
actions
  agent     walk(courier, place).
  agent     take(courier, parcel).
  agent     leave(courier, parcel).
  exogenous shift(parcel, place).
facts
  beside(dock, hall). beside(hall, dock). beside(hall, loft). beside(loft, hall).
laws
  walk(C, P)  causes at(C, P).
  take(C, B)  causes has(C, B).
  leave(C, B) causes -has(C, B).
  shift(B, P) causes at(B, P).
  at(B, P) if at(C, P), has(C, B).
  -at(T, Q) if at(T, P), P != Q.
  impossible walk(C, P)  if at(C, Q), -beside(Q, P).
  impossible take(C, B)  if at(C, P), -at(B, P).
  impossible take(C, B)  if has(C, B).
  impossible leave(C, B) if -has(C, B).
  impossible shift(B, P) if at(B, P).
  impossible shift(B, P) if has(C, B).
initially
  at(T, P) for some P.
sees
  C sees at(C, P).
  C sees at(B, P) if at(C, P).
  C sees has(C, B).
shows
  walk(C, P)  shows at(C, Q).
  take(C, B)  shows has(C, B).
  leave(C, B) shows has(C, B).
"""
PARCEL = """
name: parcel
domain: locker.al
goal: ["at(crate,dock)", "-has(pia,crate)"]
initial: ["at(pia,dock)", "at(crate,hall)"]
script: [{step: 1, action: "shift(crate,loft)"}]
exogenous_while_thinking: true
robots: [intentional, intentional-plain, intentional-joint-staged, traditional]
limits: {plan: 8, steps: 30, decision_s: null}
link: inprocess
"""
LATE = "observability={shift: {mode: always, delay: 2}}"
"""It is told of the event after it has missed the crate."""
NO_PROOFS = "limits.conflicts=1"


@pytest.fixture
def parcel(tmp_path: Path) -> Path:
    (tmp_path / "locker.al").write_text(LOCKER, encoding="utf-8")
    (tmp_path / "parcel.yaml").write_text(PARCEL, encoding="utf-8")
    return tmp_path / "parcel.yaml"


def _played(config: Path, *overrides: str) -> list[TrialRecord]:
    specs = plan_trials(load_config(config, overrides))
    return [play_trial(spec, InProcessRobot(make_robot)).record for spec in specs]


def _assuming(record: TrialRecord) -> int:
    """The number of steps at which the explanation adopted last assumes anything."""
    adopted = {own.step: bool(own.unobserved or own.distrusted) for own in record.explanations}
    now, steps = False, 0
    for step in range(1, record.steps + 1):
        now = adopted.get(step, now)
        steps += now
    return steps


@pytest.mark.parametrize("news", [(), (LATE,)])
def test_with_a_budget_every_decision_is_under_a_smallest_explanation(
    parcel: Path, news: tuple[str, ...]
) -> None:
    for record in _played(parcel, *news):
        assert record.outcome in ("achieved", "false_finish")
        assert record.explanations
        assert record.unproved_steps == 0


@pytest.mark.parametrize("news", [(), (LATE,)])
def test_where_nothing_is_proved_all_that_assume_something_count(
    parcel: Path, news: tuple[str, ...]
) -> None:
    for record in _played(parcel, NO_PROOFS, *news):
        assert record.outcome in ("achieved", "false_finish")
        assert record.unproved_steps == _assuming(record) > 0
    # Nothing is smaller than what assumes nothing.
    for record in _played(parcel, NO_PROOFS, "script=[]"):
        assert record.unproved_steps == 0


def test_a_decision_whose_diagnosis_did_not_end_counts(parcel: Path) -> None:
    """No program is small enough, so that at every step the robot waits with what it held."""
    hopeless = ("robots=[intentional-plain,intentional-joint]", "limits.ground_rules=1")
    for record in _played(parcel, *hopeless, "limits.steps=3"):
        assert (record.outcome, record.steps) == ("step_limit", 3)
        assert record.unproved_steps == 3


class Silent:
    """A robot that ends its trial and tells nothing of its mind."""

    capabilities = Capabilities()

    def begin(self, task: Task) -> None:
        pass

    def act(self, percept: Percept) -> Decision:
        return Decision(
            trial=percept.trial, step=percept.step, action=FINISH, believes_goal=True, trace=Trace()
        )


def test_of_a_robot_that_does_not_tell_it_is_not_known(parcel: Path) -> None:
    spec, *_ = plan_trials(load_config(parcel, ["robots=[intentional]"]))
    assert play_trial(spec, InProcessRobot(lambda _: Silent())).record.unproved_steps is None


def test_the_summary_has_the_mean_of_each_robot(parcel: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    given = ("robots=[intentional,traditional]", NO_PROOFS, "--workers", "1", "--quiet")
    assert CliRunner().invoke(app, ["run", str(parcel), *given, "--out", str(out)]).exit_code == 0
    records = [json.loads(line) for line in (out / "trials.jsonl").read_text().splitlines()]
    (scenario,) = json.loads((out / "summary.json").read_text())["scenarios"].values()
    assert scenario["unproved_steps"] == {own["robot"]: own["unproved_steps"] for own in records}
    assert all(scenario["unproved_steps"].values())
