"""Replaying a trial: the list to choose from, what is told of a step, and of a lost robot."""

from pathlib import Path

import pytest

from testbed.experiment.narration import Narrator
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.replay import list_trials, replay
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import write_config
from testbed.experiment.store import TrialWriter
from testbed.experiment.storyteller import Moment, Storyteller
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept, Trace
from testbed.world import World
from tests.experiment.samples import Configure


def _run(folder: Path, configure: Configure) -> list[TrialRecord]:
    """A run of one pair, of which the first trial is on record."""
    config = configure("scenarios=[5]")
    write_config(folder, config)
    records = [play_trial(s, InProcessRobot(make_robot)).record for s in plan_trials(config)]
    with TrialWriter(folder) as writer:
        writer.append(records[0])
    return records


@pytest.mark.usefixtures("at_home")
def test_the_trials_of_a_run_are_listed_with_the_way_to_choose(configure: Configure) -> None:
    first, second = _run(Path("my run"), configure)
    said: list[str] = []
    list_trials(Path("my run"), said.append)
    assert [line.split() for line in said[:3]] == [
        ["trial", "scenario", "robot", "outcome"],
        [first.trial, "5", "intentional", "achieved"],
        [second.trial, "5", "traditional", "not", "played", "yet"],
    ]
    assert said[3].endswith(f"testbed replay 'my run' --trial {second.trial}")


def test_a_robot_that_was_lost_need_not_be_lost_again(tmp_path: Path, configure: Configure) -> None:
    _, lost = _run(tmp_path, configure)
    lost.outcome, lost.reason = "robot_lost", "no answer within 1 s"
    with TrialWriter(tmp_path) as writer:
        writer.append(lost)
    said: list[str] = []
    assert replay(tmp_path, lost.trial, said.append)
    assert said[-2].startswith("outcome false_finish")
    assert "robot lost: no answer within 1 s" in said[-1]
    assert "need not be lost again" in said[-1]


def test_a_run_that_an_older_version_stored_is_told_as_recorded(
    tmp_path: Path, configure: Configure
) -> None:
    """Its configuration and its records lack the keys that came later."""
    first, _ = _run(tmp_path, configure)  # the configuration has `relevance: published`
    stored = tmp_path / "config.yaml"
    lines = stored.read_text(encoding="utf-8").splitlines(keepends=True)
    older = [line for line in lines if not line.startswith(("relevance:", "plans:"))]
    assert len(older) == len(lines) - 2
    stored.write_text("".join(older), encoding="utf-8")
    first.unproved_steps = first.unheeded_steps = first.condition = None
    (tmp_path / "trials.jsonl").unlink()
    with TrialWriter(tmp_path) as writer:
        writer.append(first)
    said: list[str] = []
    assert replay(tmp_path, first.trial, said.append)
    assert said[-1] == "as recorded"


def _told(world: World, *traces: Trace) -> list[dict[str, str]]:
    """The lines that a narrator has for steps with these traces: by their first word."""
    said: list[str] = []
    teller, narrator = Storyteller("t", world), Narrator(said.append)
    state = world.initial_states()[0]
    steps = []
    for step, trace in enumerate(traces, start=1):
        percept = Percept(trial="t", step=step, visible=[], attempted=None, happened=None)
        decision = Decision(trial="t", step=step, action="wait", believes_goal=False, trace=trace)
        said.clear()
        narrator.tell(teller.tell(Moment(percept, decision, None, None, state, state)))
        lines = [line.strip().partition(" ") for line in said]
        steps.append({word: rest.strip() for word, _, rest in lines})
    return steps


def test_a_belief_that_is_not_reported_is_not_told(world: World) -> None:
    atoms = ["loc(rob1,kitchen)"]
    told = _told(world, Trace(), Trace(belief=atoms), Trace(), Trace(belief=atoms))
    assert [step["belief"] for step in told] == ["not reported", *atoms, "not reported", *atoms]


def test_a_plan_is_told_when_it_is_new(world: World) -> None:
    plans = [["a", "b", "c"], ["b", "c"], [], ["c"], ["c", "d"], ["c", "d"], ["a", "b", "c", "d"]]
    told = _told(world, *(Trace(intention="i", plan=plan) for plan in plans))
    assert [step["intention"] for step in told] == [
        "i; plan: a b c",
        "i",
        "i",
        "i",
        "i; plan: c d",
        "i",
        "i; plan: a b c d",
    ]
