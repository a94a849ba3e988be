"""Scripts: entries at steps and with actions of the robot, and those that are not possible."""

from pathlib import Path

import pytest

from testbed.cli import app
from testbed.config import ConfigError, load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import read_records
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept, Task, Trace
from tests.greenhouse import GREENHOUSE

TEXT = """\
name: pots
domain: pots.al
goal: ["stands(fern,sill)"]
initial: ["stands(fern,bench)", "stands(rose,bench)"]
robots: [intentional]
link: inprocess
"""
HOME, AWAY = "carry(gardener,fern,sill)", "carry(gardener,rose,sill)"


class Reciter:
    """A robot that answers from a list."""

    def __init__(self, *answers: str) -> None:
        self._answers = answers

    def begin(self, task: Task) -> None:
        del task

    def act(self, percept: Percept) -> Decision:
        action = self._answers[percept.step - 1]
        return Decision(
            trial=percept.trial, step=percept.step, action=action, believes_goal=True, trace=Trace()
        )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    (tmp_path / "pots.yaml").write_text(TEXT, encoding="utf-8")
    return tmp_path


def _play(folder: Path, script: str, *answers: str, policy: str = "error") -> TrialRecord:
    overrides = [f"script={script}", f"script_policy={policy}", "robots=[traditional]"]
    (spec,) = plan_trials(load_config(folder / "pots.yaml", overrides))
    return play_trial(spec, InProcessRobot(lambda _: Reciter(*answers))).record


def _events(record: TrialRecord) -> list[tuple[int, str]]:
    return [(event.step, event.action) for event in record.exogenous]


def test_an_entry_may_be_at_an_action_of_the_robot_whatever_its_step(folder: Path) -> None:
    script = "[{at_action: 2, action: 'blow(fern,floor)'}]"
    quick = _play(folder, script, HOME, AWAY, HOME, "finish")
    assert _events(quick) == [(2, "blow(fern,floor)")]
    slow = _play(folder, script, "wait", HOME, "wait", "wait", AWAY, HOME, "finish")
    assert _events(slow) == [(5, "blow(fern,floor)")]
    assert (quick.outcome, slow.outcome) == ("achieved", "achieved")


def test_an_attempt_that_fails_is_an_action_of_the_robot_too(folder: Path) -> None:
    script = "[{at_action: 2, action: 'blow(rose,floor)'}]"
    record = _play(folder, script, "carry(gardener,fern,bench)", HOME, "finish")
    assert [attempt.happened for attempt in record.actions] == [False, True]
    assert _events(record) == [(2, "blow(rose,floor)")]


def test_steps_and_actions_may_stand_in_one_script(folder: Path) -> None:
    script = "[{step: 1, action: 'blow(rose,floor)'}, {at_action: 2, action: 'blow(rose,bench)'}]"
    record = _play(folder, script, HOME, "wait", AWAY, "finish", policy="skip")
    assert _events(record) == [(1, "blow(rose,floor)")]
    assert [(own.step, own.action) for own in record.rejected] == [(3, "blow(rose,bench)")]
    both = "[{step: 2, action: 'blow(rose,floor)'}, {at_action: 2, action: 'blow(rose,bench)'}]"
    assert _play(folder, both, HOME, AWAY, "finish").outcome == "error"


def test_the_impossible_ends_a_trial_unless_it_is_to_be_skipped(folder: Path) -> None:
    script = "[{step: 2, action: 'blow(fern,sill)'}, {step: 4, action: 'blow(rose,sill)'}]"
    answers = (HOME, "wait", AWAY, "wait", "finish")
    failed = _play(folder, script, *answers)
    assert failed.outcome == "error"
    assert "blow(fern,sill)" in str(failed.reason)
    assert failed.rejected == []
    record = _play(folder, script, *answers, policy="skip")
    assert (record.outcome, record.exogenous) == ("achieved", [])
    assert [(own.step, own.action) for own in record.rejected] == [
        (2, "blow(fern,sill)"),
        (4, "blow(rose,sill)"),
    ]
    assert all(own.reason for own in record.rejected)


def test_what_is_not_reached_is_named(folder: Path) -> None:
    script = "[{at_action: 7, action: 'blow(fern,floor)'}, {step: 9, action: 'blow(rose,sill)'}]"
    reason = str(_play(folder, script, HOME, "finish").reason)
    assert "step 9" in reason
    assert "action 7" in reason


@pytest.mark.parametrize(
    ("script", "key"),
    [
        ("[{action: 'blow(fern,sill)'}]", "script[0]"),
        ("[{step: 2, at_action: 1, action: 'blow(fern,sill)'}]", "script[0]"),
        ("[{at_action: 0, action: 'blow(fern,sill)'}]", "script[0].at_action"),
        (
            "[{at_action: 2, action: 'blow(fern,sill)'}, {at_action: 2, action: 'blow(rose,sill)'}"
            "]",
            "script[1].at_action",
        ),
    ],
)
def test_an_entry_has_one_moment_and_a_moment_one_entry(
    folder: Path, script: str, key: str
) -> None:
    with pytest.raises(ConfigError) as caught:
        load_config(folder / "pots.yaml", [f"script={script}"])
    (line,) = caught.value.lines
    assert line.startswith(f"command line: {key}: ")


def test_one_script_is_played_against_two_robots(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """At step 1 the intentional robot waits, when nothing happens, and the traditional one acts."""
    script = "[{step: 1, action: 'blow(rose,floor)'}, {at_action: 1, action: 'blow(rose,sill)'}]"
    given = [f"script={script}", "script_policy=skip", "robots=[intentional, traditional]"]
    run = folder / "run"
    assert _testbed("run", str(folder / "pots.yaml"), *given, "--out", str(run), "--quiet") == 0
    records = {record.robot: record for record in read_records(run)}
    assert {record.outcome for record in records.values()} == {"achieved"}
    assert _events(records["intentional"]) == [(2, "blow(rose,sill)")]
    assert [own.step for own in records["intentional"].rejected] == [1]
    assert _events(records["traditional"]) == [(1, "blow(rose,floor)")]
    assert [own.action for own in records["traditional"].rejected] == ["blow(rose,sill)"]
    capsys.readouterr()
    assert _testbed("replay", str(run), "--trial", records["intentional"].trial) == 0
    assert "blow(rose,floor)" in capsys.readouterr().out


def _testbed(*arguments: str) -> int:
    with pytest.raises(SystemExit) as ended:
        app(list(arguments))
    return int(ended.value.code or 0)
