"""The slowest trials, and those that were not correct, with the commands that replay them."""

import re
import shlex
from pathlib import Path

import pytest

from testbed.analysis.table import table_of
from testbed.config import load_config
from testbed.experiment.record import TrialRecord
from testbed.experiment.store import TrialWriter
from testbed.report.page import written_report
from testbed.report.stories import LISTED, SLOWEST, command_of, failures, slowest
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


def _bad(count: int) -> list[TrialRecord]:
    return [
        a_record(
            f"bad{n:03}", pair=f"{n:03}", correct=False, achieved=False, outcome="false_finish"
        )
        for n in range(count)
    ]


def test_every_trial_that_is_not_correct_is_there_once_and_no_other() -> None:
    good = [a_record(f"good{n}") for n in range(5)]
    ((group, count, records),) = failures(table_of([*good, *_bad(LISTED)]))
    assert [record.trial for record in records] == [f"bad{n:03}" for n in range(LISTED)]
    assert count == LISTED
    assert (group.place, group.robot, group.ending) == ("scenario 1", "intentional", "false finish")


def test_of_an_ending_of_many_trials_some_are_listed_and_all_counted() -> None:
    many, other = _bad(LISTED + 9), a_record("other", correct=False, outcome="gave_up")
    told = failures(table_of([*reversed(many), other]))
    assert [(count, len(records)) for _, count, records in told] == [(LISTED + 9, LISTED), (1, 1)]
    assert {own.trial for own in told[0][2]} == {own.trial for own in many[:LISTED]}


@pytest.mark.parametrize("served", [False, True])
def test_only_trials_that_the_page_can_show_have_links(
    tmp_path: Path, served: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("testbed.report.sample.MOST_TRIALS", 20)
    with TrialWriter(tmp_path) as writer:
        for record in _bad(LISTED + 9):
            writer.append(record)
    report = written_report(tmp_path, load_config("office"))
    listed = report.page(served).partition('id="failures"')[2].partition("<footer>")[0]
    items = re.findall("<li>.*?</li>", listed, re.DOTALL)
    assert len(items) == listed.count(f"testbed replay {tmp_path} --trial bad") == LISTED
    assert f"{LISTED} of {LISTED + 9} trials" in listed
    linked = re.findall('href="#trial=(.*?)&', listed)
    assert linked == [f"bad{n:03}" for n in range(LISTED if served else 20)]


def test_lost_robots_come_first_with_their_reason() -> None:
    wrong = a_record("a", correct=False, achieved=False, outcome="gave_up", reason="no plan")
    lost = a_record("b", correct=False, achieved=False, outcome="robot_lost", reason="signal 9")
    (first, *_), (second, *_) = failures(table_of([wrong, lost]))
    assert (first.ending, first.lost) == ("robot lost: signal 9", True)
    assert (second.ending, second.lost) == ("gave up", False)


def test_more_actions_than_the_fewest_are_an_ending_of_their_own() -> None:
    ((group, *_),) = failures(table_of([a_record(correct=False)]))
    assert group.ending == "achieved, not with the fewest actions"


def test_a_goal_out_of_reach_is_said_to_be() -> None:
    record = a_record(correct=False, achieved=False, outcome="gave_up", in_reach=False)
    assert failures(table_of([record]))[0][0].ending == "gave up, out of reach"
