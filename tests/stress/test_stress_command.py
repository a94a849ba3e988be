"""The command: what it writes replays, tests fail as long as the finding is there, exit codes."""

import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.stress import findings
from testbed.stress.cases import cases_of
from testbed.stress.catalogue import Kind
from testbed.stress.journal import JOURNAL
from testbed.stress.shrinking import Shrunk
from testbed.stress.stories import write_stories
from testbed.stress.verdicts import Finding
from tests.stress.domains import search_in, write_search

ONE = ["--events", "1"]


@pytest.fixture(scope="module")
def office(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a search of the packaged configuration, in its smallest size."""
    folder = tmp_path_factory.mktemp("office") / "found"
    small = ["limit=2", "sweep.grid={goal_feedback: [false]}", "robots=[traditional]"]
    done = CliRunner().invoke(app, ["stress", "stress", *small, *ONE, "--out", str(folder)])
    assert done.exit_code == 1, done.output
    return folder


def test_the_published_failure_of_planning_alone_is_found(office: Path) -> None:
    (story,) = office.glob("story-*.yaml")
    (found,) = findings(story)
    assert (found.objective, found.rule) == ("fail", "false_finish")


def test_a_story_is_a_run(office: Path, tmp_path: Path) -> None:
    (story,) = office.glob("story-*.yaml")
    run = tmp_path / "run"
    done = CliRunner().invoke(app, ["run", str(story), "--out", str(run), "--quiet"])
    assert done.exit_code == 0
    record = (run / "trials.jsonl").read_text(encoding="utf-8")
    assert '"outcome":"false_finish"' in record


def test_its_tests_fail_as_long_as_the_finding_is_there(office: Path) -> None:
    tests = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(office)]
    assert subprocess.run(tests, capture_output=True).returncode == 1
    (story,) = office.glob("story-*.yaml")
    text = story.read_text(encoding="utf-8")
    try:
        story.write_text(text.replace("- traditional", "- intentional"), encoding="utf-8")
        assert subprocess.run(tests, capture_output=True).returncode == 0
    finally:
        story.write_text(text, encoding="utf-8")


def test_nothing_found_is_a_success(tmp_path: Path) -> None:
    config = write_search(tmp_path, "greenhouse")
    folder = tmp_path / "found"
    given = ["robots=[intentional]", *ONE, "--out", str(folder)]
    done = CliRunner().invoke(app, ["stress", str(config), *given])
    assert done.exit_code == 0, done.output
    assert not list(folder.glob("story-*"))
    longer = [*given, "--minutes", "11", "--resume"]
    done = CliRunner().invoke(app, ["stress", str(config), *longer])
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("given", "key"),
    [
        (["stress.objectives=[luck]"], "stress.objectives"),
        (["stress.objectives=[]"], "stress.objectives"),
        (["--minutes", "0"], "stress.minutes"),
        (["--events", "0"], "stress.events"),
        (["stress.vary=[mood]"], "stress.vary"),
        (["stress.colour=1"], "stress.colour"),
    ],
)
def test_bad_input_is_one_line(given: list[str], key: str, tmp_path: Path) -> None:
    config = write_search(tmp_path, "greenhouse")
    done = CliRunner().invoke(app, ["stress", str(config), *given])
    assert done.exit_code == 2
    (line,) = done.stderr.splitlines()
    assert key in line


def test_a_journal_that_is_none_is_refused(tmp_path: Path) -> None:
    config, folder = write_search(tmp_path, "greenhouse"), tmp_path / "found"
    done = CliRunner().invoke(app, ["stress", str(config), *ONE, "--out", str(folder)])
    assert done.exit_code in (0, 1)
    (folder / JOURNAL).write_text("{}\n", encoding="utf-8")
    again = ["stress", str(config), *ONE, "--out", str(folder), "--resume", "--quiet"]
    done = CliRunner().invoke(app, again)
    assert (done.exit_code, len(done.stderr.splitlines())) == (2, 1)


def test_a_robot_of_ones_own_that_raises_an_error_is_a_finding(tmp_path: Path) -> None:
    config = write_search(tmp_path, "greenhouse")
    (tmp_path / "robot_that_trips.py").write_text(TRIPS, encoding="utf-8")
    folder = tmp_path / "found"
    given = ["robots=[robot_that_trips:Trips]", *ONE, "--out", str(folder), "--workers", "2"]
    done = CliRunner().invoke(app, ["stress", str(config), *given])
    assert done.exit_code == 1, done.output
    (story,) = folder.glob("story-*.yaml")
    (found,) = findings(story)
    assert "over a pot" in found.detail


@pytest.mark.parametrize("robot", ["NoWay", "NoWayBack", "Forgets", "Moody"])
def test_a_robot_that_cannot_go_back_is_refused_in_one_line(tmp_path: Path, robot: str) -> None:
    config = write_search(tmp_path, "greenhouse")
    (tmp_path / "robots_that_stray.py").write_text(STRAYS, encoding="utf-8")
    given = [f"robots=[robots_that_stray:{robot}]", *ONE, "--out", str(tmp_path / "found")]
    done = CliRunner().invoke(app, ["stress", str(config), *given, "--quiet"])
    (line,) = done.stderr.splitlines()
    assert (done.exit_code, robot in line) == (2, True)


@pytest.mark.parametrize(
    "robot", ["Plain", "NoTrace", "NoBelief", "Elsewhere", "Flies", "Breaks", "Surrogate", "Never"]
)
def test_whatever_a_robot_says_is_told_and_replays(tmp_path: Path, robot: str) -> None:
    config = write_search(tmp_path, "greenhouse")
    (tmp_path / "robots_that_talk.py").write_text(TALKS, encoding="utf-8")
    folder = tmp_path / "found"
    given = [f"robots=[robots_that_talk:{robot}]", "limit=1", "--events", "1"]
    objectives = "stress.objectives=[fail, principles, reasoning]"
    command = ["stress", str(config), *given, objectives, "--out", str(folder)]
    done = CliRunner().invoke(app, command)
    assert (done.exit_code, done.exception) == (1, None) or isinstance(done.exception, SystemExit)
    stories = [*folder.glob("story-*.yaml")]
    assert stories
    for story in stories:
        assert findings(story)
    again = CliRunner().invoke(app, [*command, "--resume"])
    assert again.exit_code == 1


def test_stories_of_an_earlier_part_are_replaced_and_no_other_file(tmp_path: Path) -> None:
    config = search_in(tmp_path, "greenhouse")
    (tmp_path / "story-mine.yaml").write_text("mine", encoding="utf-8")
    case = cases_of(config)[0]
    finding = Finding("fail", "gave_up", None, "nothing")
    told = Shrunk(case, (), 1, None, finding)
    for rule in ("gave_up", "step_limit"):
        write_stories(tmp_path, config, {Kind(case.robot, "fail", rule, ()): told})
    left = {own.name for own in tmp_path.glob("story-*")}
    assert left == {"story-mine.yaml", f"story-{case.robot}-fail-step-limit.yaml"}


def test_a_finding_that_is_not_there_again_is_told_as_such(tmp_path: Path) -> None:
    config = write_search(tmp_path, "greenhouse")
    (tmp_path / "robots_that_trip_once.py").write_text(STRAYS, encoding="utf-8")
    folder = tmp_path / "found"
    given = ["robots=[robots_that_trip_once:Once]", "limit=1", *ONE, "--out", str(folder)]
    done = CliRunner().invoke(app, ["stress", str(config), *given])
    assert (done.exit_code, "tripped once" in done.output) == (1, True)
    again = [found.detail for story in folder.glob("story-*.yaml") for found in findings(story)]
    assert not any("tripped once" in detail for detail in again)


TRIPS = """\
from testbed.protocol import Capabilities


class Trips:
    capabilities = Capabilities()

    def begin(self, task):
        pass

    def act(self, percept):
        raise RuntimeError("tripped over a pot")
"""

TALKS = """\
from asp.language import Literal
from testbed.protocol import FINISH, WAIT, Capabilities, Decision, Trace


class Plain:
    capabilities = Capabilities()
    action, named, trace, stopped = "finish", None, Trace(), None

    def begin(self, task):
        pass

    def act(self, percept):
        return Decision(trial=self.named or percept.trial, step=percept.step, action=self.action,
                        believes_goal=False, trace=self.trace, stopped=self.stopped)


class NoTrace(Plain):
    trace = None


class NoBelief(Plain):
    trace = Trace(belief=[5])


class Elsewhere(Plain):
    named = "another"


class Flies(Plain):
    action = WAIT
    trace = Trace(belief=["stands(fern,bench)", "stands(rose,bench)"], plan=["fly(moon)"],
                  mental="stop(1)", intention="stop(1)")


class Breaks(Plain):
    trace = Trace(reason="a\\nb: [c \\x1b[31m")


class Surrogate(Plain):
    stopped = "\\udce9 caf\\ny: ["


class Never(Plain):
    trace = Trace(planning_cpu_s=float("nan"))
"""
STRAYS = """\
from itertools import count

from asp.language import Literal
from testbed.protocol import FINISH, Capabilities, Decision, Trace

PLAN = [Literal.parse(f"carry(gardener,{pot},{place})")
        for _ in range(2) for pot in ("fern", "rose") for place in ("floor", "sill")]
MADE = count()


class Strays:
    capabilities = Capabilities(snapshots=True)

    def begin(self, task):
        self.asked = 0

    def act(self, percept):
        action = self.next()
        self.asked += 1
        return Decision(trial=percept.trial, step=percept.step, action=action,
                        believes_goal=False, trace=Trace())

    def next(self):
        return PLAN[self.asked] if self.asked < len(PLAN) else FINISH

    def snapshot(self):
        return self.asked

    def restore(self, snapshot):
        self.asked = snapshot


class NoWay(Strays):
    def snapshot(self):
        raise RuntimeError("no way")


class NoWayBack(Strays):
    def restore(self, snapshot):
        raise RuntimeError("no way back")


class Forgets(Strays):
    def restore(self, snapshot):
        self.asked = len(PLAN)


class Moody(Strays):
    capabilities = Capabilities()

    def begin(self, task):
        self.asked = next(MADE) % 2


class Once(Strays):
    def next(self):
        if next(MADE) == 12:
            raise RuntimeError("tripped once")
        return super().next()
"""
