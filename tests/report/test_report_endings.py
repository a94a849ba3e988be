"""The slowest trials, and every one that was not correct, with the commands that replay them."""

import shlex
from pathlib import Path

from testbed.analysis.table import table_of
from testbed.experiment.record import Occurrence
from testbed.report.stories import SLOWEST, failures, slowest
from tests.experiment.samples import a_record

RUN = Path("runs/o'clock")


def test_the_slowest_come_first() -> None:
    seconds = [(7 * number) % 23 / 10 for number in range(SLOWEST + 5)]
    records = [a_record(f"t{n}", reasoning_time_s=own) for n, own in enumerate(seconds)]
    told = slowest(table_of(records), RUN)
    assert [trial.seconds for trial in told] == sorted(seconds, reverse=True)[:SLOWEST]
    first = f"t{seconds.index(max(seconds))}"
    assert shlex.split(told[0].command) == ["testbed", "replay", str(RUN), "--trial", first]


def test_every_trial_that_is_not_correct_is_there_once_and_no_other() -> None:
    bad = [
        a_record(f"bad{n}", correct=False, achieved=False, outcome="false_finish")
        for n in range(200)
    ]
    good = [a_record(f"good{n}") for n in range(5)]
    (group,) = failures([*good, *bad], RUN)
    commands = [shlex.split(command)[-1] for command, _ in group.lines]
    assert commands == [f"bad{n}" for n in range(200)]
    assert (group.place, group.robot, group.ending) == ("scenario 1", "intentional", "false finish")


def test_lost_robots_come_first_with_their_reason() -> None:
    wrong = a_record("a", correct=False, achieved=False, outcome="gave_up", reason="no plan")
    lost = a_record("b", correct=False, achieved=False, outcome="robot_lost", reason="signal 9")
    first, second = failures([wrong, lost], RUN)
    assert (first.ending, first.lost) == ("robot lost: signal 9", True)
    assert (second.ending, second.lost) == ("gave up", False)


def test_a_trial_tells_what_others_did_in_it() -> None:
    events = [Occurrence(3, "exo_lock(library)", False)]
    (group,) = failures([a_record(correct=False, exogenous=events)], RUN)
    assert group.lines[0][1] == "exo_lock(library) at step 3"
    assert group.ending == "achieved, not with the fewest actions"


def test_a_goal_out_of_reach_is_said_to_be() -> None:
    record = a_record(correct=False, achieved=False, outcome="gave_up", in_reach=False)
    assert failures([record], RUN)[0].ending == "gave up, out of reach"
