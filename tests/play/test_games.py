"""Games of a person, by numbers through a pipe and by keys of a pseudo-terminal."""

import fcntl
import io
import os
import select
import subprocess
import sys
import termios
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.replay import replay
from testbed.experiment.robots import make_robot
from testbed.experiment.store import read_records
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.play import Quit, game_of, keep, played
from testbed.play.asking import Asker, ByKeys, ByLines
from testbed.play.keys import Keys
from testbed.protocol import FINISH, WAIT
from testbed.search import cheapest_plan
from testbed.world import load_world
from tests import games

PROMPT = "number, or q to leave:"
DOMAINS = ("office", "harbour", "lanterns")


def _source(folder: Path, domain: str) -> str:
    return domain if domain == "office" else str(games.config_of(folder, domain))


def _play(folder: Path, domain: str, typed: str, *given: str) -> Result:
    source, out = _source(folder, domain), str(folder / "kept")
    return CliRunner().invoke(app, ["play", source, *given, "--out", out], input=typed)


def _kept(folder: Path) -> TrialRecord:
    (record,) = read_records(folder / "kept")
    said: list[str] = []
    assert replay(folder / "kept", record.trial, said.append), said
    return record


@pytest.mark.parametrize("domain", DOMAINS)
def test_an_adversary_by_numbers(tmp_path: Path, domain: str) -> None:
    config = load_config(_source(tmp_path, domain))
    world = load_world(config.domain)
    number = len(world.exogenous_actions)  # 0 is none
    typed = f"{number}\n" + "0\n" * 60
    done = _play(tmp_path, domain, typed, "adversary.budget=1", "robots=[traditional]")
    assert done.exit_code == 0, done.output
    record = _kept(tmp_path)
    (event,) = record.exogenous or [None]
    assert event is None or event.action in world.exogenous_actions
    assert record.robot == "traditional"
    summary = (tmp_path / "kept" / "summary.json").read_text(encoding="utf-8")
    assert '"trials": 1' in summary


@pytest.mark.parametrize("domain", DOMAINS)
def test_a_robot_by_numbers(tmp_path: Path, domain: str) -> None:
    config = load_config(_source(tmp_path, domain), ["adversary.strategy=none"])
    (spec, *_) = plan_trials(config)
    world = load_world(config.domain)
    plan = cheapest_plan((world, world.state(spec.initial), spec.setting.goal))
    assert plan
    answers = (WAIT, FINISH, *world.agent_actions)
    typed = [answers.index(own) for own in ("wait", *plan, "finish")]
    done = _play(
        tmp_path, domain, "\n".join(map(str, typed)), "adversary.strategy=none", *("--as", "robot")
    )
    assert done.exit_code == 0, done.output
    record = _kept(tmp_path)
    assert [own.action for own in record.actions] == [*plan]
    assert (record.robot, record.outcome, record.correct) == ("human", "achieved", True)


def test_a_robot_remembers_what_it_saw_last(tmp_path: Path) -> None:
    """In the harbour the mate sees only the berth that it is at."""
    world = load_world(load_config(_source(tmp_path, "harbour")).domain)
    answers = (WAIT, FINISH, *world.agent_actions)
    typed = [answers.index(own) for own in ("sail(mate,east)", "sail(mate,dock)")]
    script = "script=[{step: 1, action: 'drift(salt,west)'}]"
    lines = "\n".join(map(str, [*typed, "q"]))
    done = _play(tmp_path, "harbour", lines, script, "--as", "robot")
    assert done.exit_code == 0, done.output
    first, away, back, _ = done.output.split(PROMPT)
    assert "lies(salt,dock)" in first.partition("0  wait")[0]
    assert "lies(salt,dock)" in away.partition("0  wait")[0]  # though it has drifted since
    assert "lies(salt,dock)" not in back.partition("0  wait")[0]


@pytest.fixture
def ends() -> Iterator[tuple[int, int]]:
    """The ends of a pseudo-terminal: the person's, and the program's."""
    person, program = os.openpty()
    yield person, program
    os.close(person)
    os.close(program)


@pytest.mark.parametrize("domain", DOMAINS)
def test_an_adversary_by_keys(ends: tuple[int, int], tmp_path: Path, domain: str) -> None:
    person, program = ends
    given = ["adversary.budget=1", "robots=[traditional]"]
    config = load_config(_source(tmp_path, domain), given)
    game = game_of(config, "adversary")
    with Keys(program) as keys:
        os.write(person, b"\x1b[B\n")  # the first event that is legal
        result = played(game, ByKeys(keys, io.StringIO()), lambda _: None)
    assert len(result.record.exogenous) == 1
    trial = keep(game, result, tmp_path / "kept", ["testbed"])
    assert _kept(tmp_path).trial == trial
    again = plan_trials(load_config(tmp_path / "kept" / "config.yaml", ["robots=[intentional]"]))
    events = [own.action for own in played_again(again[0]).exogenous]
    assert set(events) <= {own.action for own in result.record.exogenous}


def played_again(spec: object) -> TrialRecord:
    """The record of a trial that is played in this process."""
    return play_trial(spec, InProcessRobot(make_robot)).record  # type: ignore[arg-type]


def _asker(text: str, said: list[str]) -> Asker:
    return ByLines(io.StringIO(text), said.append)


@pytest.mark.parametrize("typed", ["q\n", "", "999\n", "a" * 100_000 + "\nq\n"])
def test_who_leaves_keeps_nothing(tmp_path: Path, typed: str) -> None:
    done = _play(tmp_path, "harbour", typed)
    assert done.exit_code == 0, done.output
    assert not (tmp_path / "kept").exists()


@pytest.mark.parametrize("typed", ["-1", "9" * 5_000, "drift", "²", "\x1b[2J", "drift(silk,\x00)"])
def test_what_is_no_choice_is_asked_again(tmp_path: Path, typed: str) -> None:
    game = game_of(load_config(_source(tmp_path, "harbour")), "adversary")
    said: list[str] = []
    with pytest.raises(Quit):
        played(game, _asker(f"{typed}\nq\n", said), said.append)
    assert said.count(PROMPT) == 2


@pytest.mark.parametrize(
    ("given", "key"),
    [
        (["run", "quickstart", "adversary.strategy=human"], "adversary.strategy"),
        (["run", "quickstart", "robots=[human]"], "robots"),
        (["play", "quickstart", "--as", "judge"], "--as"),
        (["play", "levels"], "levels"),
        (["play", "quickstart", "robots=[hunam]"], "robots"),
    ],
)
def test_what_cannot_be_played_is_one_line(given: list[str], key: str) -> None:
    done = CliRunner().invoke(app, given)
    assert done.exit_code == 2
    (line,) = done.stderr.splitlines()
    assert key in line


@pytest.mark.parametrize("given", ["adversary.strategy=human", "robots=[human]"])
def test_where_nobody_is_there_a_trial_says_so(tmp_path: Path, given: str) -> None:
    specs = plan_trials(load_config(_source(tmp_path, "lanterns"), [given]))
    record = played_again(specs[0])
    assert record.outcome == "error"
    assert record.reason is not None
    assert "testbed play" in record.reason


def test_a_game_that_is_not_on_record_is_not_replayed(tmp_path: Path) -> None:
    done = _play(tmp_path, "lanterns", "1\n1\n", "--as", "robot")
    assert done.exit_code == 0, done.output
    (tmp_path / "kept" / "trials.jsonl").write_bytes(b"")
    (spec,) = plan_trials(load_config(tmp_path / "kept" / "config.yaml"))
    done = CliRunner().invoke(app, ["replay", str(tmp_path / "kept"), "--trial", spec.trial])
    assert "not on record" in done.output


def _in_a_terminal(folder: Path, *turns: tuple[bytes, bytes]) -> int:
    """The exit code of a game whose person waits for a text and presses keys, turn by turn.

    The terminal has to be as it was when the command ends.
    """
    person, program = os.openpty()
    before = termios.tcgetattr(program)
    command = [sys.executable, "-m", "testbed", "play", "office", "--out", str(folder / "kept")]
    env = {**os.environ, "TERM": "xterm", "COLUMNS": "100", "LINES": "40"}
    process = subprocess.Popen(
        command,
        stdin=program,
        stdout=program,
        stderr=program,
        env=env,
        preexec_fn=partial(_own_terminal, program),
    )
    shown = b""
    for awaited, keys in turns:
        while awaited not in shown:
            assert select.select([person], [], [], 60)[0], shown
            shown += os.read(person, 4096)
        shown = shown.partition(awaited)[2]
        os.write(person, keys)
    code = process.wait(60)
    assert termios.tcgetattr(program) == before
    os.close(program)
    os.close(person)
    return code


def _own_terminal(program: int) -> None:
    """Let a pseudo-terminal control this process, so that Ctrl-C there interrupts it."""
    os.setsid()
    fcntl.ioctl(program, termios.TIOCSCTTY, 0)


@pytest.mark.parametrize(("last", "code"), [(b"q", 0), (b"\x03", 130)])
def test_a_person_leaves_a_terminal(tmp_path: Path, last: bytes, code: int) -> None:
    menu = b"q leaves"
    turns = [(menu, b"\x1b[B\n"), (b"chosen: exo_", b""), (menu, last)]
    assert _in_a_terminal(tmp_path, *turns) == code
    assert not (tmp_path / "kept").exists()
