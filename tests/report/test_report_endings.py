"""The slowest trials, and every one that was not correct, with the commands that replay them."""

import shlex
from pathlib import Path

from testbed.analysis.table import table_of
from testbed.report.stories import SLOWEST, command_of, failures, slowest
from tests.experiment.samples import a_record

RUN = Path("runs/o'clock")


def test_the_slowest_come_first() -> None:
    seconds = [(7 * number) % 23 / 10 for number in range(SLOWEST + 5)]
    records = [a_record(f"t{n}", reasoning_time_s=own) for n, own in enumerate(seconds)]
    told = slowest(table_of(records))
    assert [trial.reasoning_time_s for trial in told] == sorted(seconds, reverse=True)[:SLOWEST]
    first = f"t{seconds.index(max(seconds))}"
    assert told[0].trial == first
    assert shlex.split(command_of(RUN, first)) == ["testbed", "replay", str(RUN), "--trial", first]


def test_every_trial_that_is_not_correct_is_there_once_and_no_other() -> None:
    bad = [
        a_record(f"bad{n}", correct=False, achieved=False, outcome="false_finish")
        for n in range(200)
    ]
    good = [a_record(f"good{n}") for n in range(5)]
    ((group, records),) = failures(table_of([*good, *bad]))
    assert [record.trial for record in records] == [f"bad{n}" for n in range(200)]
    assert (group.place, group.robot, group.ending) == ("scenario 1", "intentional", "false finish")


def test_lost_robots_come_first_with_their_reason() -> None:
    wrong = a_record("a", correct=False, achieved=False, outcome="gave_up", reason="no plan")
    lost = a_record("b", correct=False, achieved=False, outcome="robot_lost", reason="signal 9")
    (first, _), (second, _) = failures(table_of([wrong, lost]))
    assert (first.ending, first.lost) == ("robot lost: signal 9", True)
    assert (second.ending, second.lost) == ("gave up", False)


def test_more_actions_than_the_fewest_are_an_ending_of_their_own() -> None:
    ((group, _),) = failures(table_of([a_record(correct=False)]))
    assert group.ending == "achieved, not with the fewest actions"


def test_a_goal_out_of_reach_is_said_to_be() -> None:
    record = a_record(correct=False, achieved=False, outcome="gave_up", in_reach=False)
    assert failures(table_of([record]))[0][0].ending == "gave up, out of reach"
