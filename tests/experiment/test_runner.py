"""Runs with real robots in real processes, and with faults injected for real."""

import json
import os
import signal
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from itertools import count
from multiprocessing import active_children
from pathlib import Path

import pytest

from testbed.config import ConfigError, ExperimentConfig, load_config
from testbed.experiment import StoreError, run
from testbed.experiment.digest import logical
from testbed.experiment.plan import plan_trials
from testbed.experiment.recorder import Result, blank_record
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import read_config
from testbed.experiment.runner import play_missing, player
from testbed.experiment.specs import TrialSpec
from testbed.experiment.status import RunStatus
from testbed.experiment.store import read_records
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.experiment.worker import Play
from testbed.experiment.worker_pool import WORTH, play_all, workers_for
from testbed.link import spawned_robot
from testbed.protocol import Robot
from tests.experiment.samples import Configure, ids

pytestmark = pytest.mark.load

SMALL = ("scenarios=[1,2,6]",)


def _ignore(tally: RunStatus) -> None:
    del tally


def _run(config: ExperimentConfig, folder: Path, workers: int = 1) -> list[dict[str, object]]:
    play_missing(config, folder, workers, _ignore)
    return [logical(record) for record in read_records(folder)]


def _planned(config: ExperimentConfig) -> list[str]:
    return [spec.trial for spec in plan_trials(config)]


def test_the_same_seed_gives_the_same_trials_wherever_they_are_played(
    tmp_path: Path, configure: Configure
) -> None:
    here = _run(configure(*SMALL), tmp_path / "here")
    assert _run(configure(*SMALL, "link=zenoh"), tmp_path / "zenoh") == here
    assert _run(configure(*SMALL), tmp_path / "two", workers=2) == here
    assert [trial["trial"] for trial in here] == _planned(configure(*SMALL))


@pytest.fixture(scope="module")
def drawn_here(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, object]]:
    """Trials in which initial states, events and news of them are drawn, played in process."""
    return _run(_drawing("inprocess"), tmp_path_factory.mktemp("drawn"))


def _drawing(link: str) -> ExperimentConfig:
    heard = "observability={exo_move: {mode: always, probability: 0.7}}"
    return load_config("office", [f"link={link}", "scenarios=[3,random]", "limit=4", heard])


def test_the_trials_to_compare_draw_something(drawn_here: list[dict[str, object]]) -> None:
    events = [event for trial in drawn_here for event in _listed(trial["exogenous"])]
    assert len({event["action"] for event in events}) > 2
    assert {event["observed"] for event in events} == {True, False}


def _listed(events: object) -> list[dict[str, object]]:
    assert isinstance(events, list)
    return events


@pytest.mark.parametrize(("link", "workers"), [("inprocess", 2), ("zenoh", 1), ("zenoh", 2)])
def test_what_is_drawn_follows_from_the_seed_wherever_it_is_played(
    tmp_path: Path, drawn_here: list[dict[str, object]], link: str, workers: int
) -> None:
    assert _run(_drawing(link), tmp_path, workers) == drawn_here


def test_a_run_goes_on_with_exactly_what_is_missing(tmp_path: Path, configure: Configure) -> None:
    config = configure("scenarios=[1,2]")
    whole = _run(config, tmp_path / "whole")
    _run(config, tmp_path / "part")
    path = tmp_path / "part" / "trials.jsonl"
    first, second, third, _ = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(first + second + third[:50])
    told: list[tuple[int, int]] = []
    play_missing(
        config, tmp_path / "part", 1, lambda tally: told.append((tally.planned, tally.done))
    )
    assert told == [(4, 2), (4, 3), (4, 4)]
    assert path.read_bytes().startswith(first + second)
    assert [logical(record) for record in read_records(tmp_path / "part")] == whole
    before = path.read_bytes()
    tally = play_missing(config, tmp_path / "part", 1, _ignore)
    assert (tally.done, tally.failed, path.read_bytes()) == (4, 0, before)


def test_a_killed_robot_costs_its_trial_alone(configure: Configure) -> None:
    config = configure("link=zenoh", "scenarios=[1]", "limit=1")
    doomed, after = plan_trials(config)
    with spawned_robot("killing", 60.0) as robot:

        def kill(moment: Moment) -> None:
            if moment.percept.step == 3:
                assert robot.process is not None
                os.kill(robot.process.pid, signal.SIGKILL)

        lost = play_trial(doomed, robot, watch=kill).record
        fine = play_trial(after, robot).record
    assert (lost.outcome, lost.cause) == ("robot_lost", "infrastructure")
    assert lost.reason is not None
    assert "signal 9" in lost.reason
    assert (lost.steps, lost.finished, lost.achieved) == (3, False, False)
    assert len(lost.actions) == 2
    assert (fine.outcome, fine.correct) == ("achieved", True)


@contextmanager
def _fragile(victim: str) -> Iterator[Play]:
    """Plays in process, but a worker that is given the victim dies of it."""
    with player("inprocess", "fragile", 60.0) as play:

        def play_or_die(spec: TrialSpec) -> Result:
            if spec.trial == victim:
                os.kill(os.getpid(), signal.SIGKILL)
            return play(spec)

        yield play_or_die


@pytest.mark.parametrize("doomed", [0, 1])
def test_a_killed_worker_costs_its_trial_alone(configure: Configure, doomed: int) -> None:
    """Also where it was to play the other trial of the pair next."""
    specs = plan_trials(configure("scenarios=[1,2]"))
    victim = specs[doomed].trial
    results = dict(play_all(specs, 2, partial(_fragile, victim)))
    assert sorted(results) == [0, 1, 2, 3]
    records = [results[position].record for position in range(4)]
    assert ids(records) == [spec.trial for spec in specs]
    assert [record.outcome for record in records if record.trial != victim] == ["achieved"] * 3
    assert (records[doomed].outcome, records[doomed].cause) == ("error", "infrastructure")
    assert records[doomed].retried == [records[doomed].reason]
    assert records[doomed].reason == "worker process ended with exit code -9"


@contextmanager
def _fragile_once(mark: Path, victim: str) -> Iterator[Play]:
    with player("inprocess", "fragile", 60.0) as play:

        def play_or_die(spec: TrialSpec) -> Result:
            if spec.trial == victim and not mark.exists():
                mark.touch()
                os.kill(os.getpid(), signal.SIGKILL)
            return play(spec)

        yield play_or_die


@contextmanager
def _robot_killed_once(mark: Path, victim: str) -> Iterator[Play]:
    with spawned_robot("killing", 60.0) as robot:

        def play(spec: TrialSpec) -> Result:
            def kill(moment: Moment) -> None:
                if spec.trial == victim and moment.percept.step == 3 and not mark.exists():
                    mark.touch()
                    assert robot.process is not None
                    os.kill(robot.process.pid, signal.SIGKILL)

            return play_trial(spec, robot, watch=kill)

        yield play


@pytest.mark.parametrize(("killing", "workers"), [(_fragile_once, 2), (_robot_killed_once, 0)])
def test_what_infrastructure_fails_once_costs_nothing(
    tmp_path: Path,
    configure: Configure,
    killing: Callable[[Path, str], AbstractContextManager[Play]],
    workers: int,
) -> None:
    specs = plan_trials(configure("scenarios=[1]"))
    victim = specs[0].trial
    results = dict(play_all(specs, workers, partial(killing, tmp_path / "mark", victim)))
    records = [results[position].record for position in range(len(specs))]
    assert (tmp_path / "mark").exists()
    assert [record.outcome for record in records] == ["achieved"] * len(specs)
    assert [len(record.retried) for record in records] == [1] + [0] * (len(specs) - 1)
    assert "9" in records[0].retried[0], "the signal"


@contextmanager
def _instant() -> Iterator[Play]:
    yield lambda spec: Result(blank_record(spec))


@contextmanager
def _signed() -> Iterator[Play]:
    """Says in which process each trial was played, and as which of its trials."""
    number = count()
    yield lambda spec: Result(blank_record(spec), f"{os.getpid()} {next(number)}")


def test_the_trials_of_a_pair_are_played_by_one_worker_one_after_the_other(
    configure: Configure,
) -> None:
    specs = plan_trials(configure("robots=[intentional,traditional,intentional-checking]"))
    played = dict(play_all(specs, 2, _signed))
    assert sorted(played) == list(range(len(specs)))
    pairs: dict[str, list[tuple[int, int]]] = {}
    for position, spec in enumerate(specs):
        process, number = map(int, (played[position].details or "").split())
        pairs.setdefault(spec.pair, []).append((process, number))
    assert len(pairs) == len(specs) / 3
    for own in pairs.values():
        process, first = own[0]
        assert own == [(process, first + later) for later in range(3)]


@contextmanager
def _waiting(first: str, held: Path) -> Iterator[Play]:
    def play(spec: TrialSpec) -> Result:
        while spec.trial == first and held.exists():
            time.sleep(0.01)
        return Result(blank_record(spec))

    yield play


def test_no_more_trials_wait_for_an_earlier_one_than_memory_is_to_hold(
    tmp_path: Path, configure: Configure, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first pair is held until the other worker has played all that may wait for it."""
    monkeypatch.setattr("testbed.experiment.worker_pool.AHEAD", 6)
    specs = plan_trials(configure("scenarios=[1,2,3,4,5,6]"))
    held = tmp_path / "held"
    held.touch()
    came = list[int]()
    for position, _ in play_all(specs, 2, partial(_waiting, specs[0].trial, held)):
        came.append(position)
        if len(came) == 4:
            held.unlink()
    assert came[:4] == [2, 3, 4, 5]
    assert sorted(came) == list(range(len(specs)))
    assert max(came[: came.index(0)]) < 6


def _instantly(*_: object) -> AbstractContextManager[Play]:
    return _instant()


def test_a_crew_larger_than_its_work_plays_each_trial_once(configure: Configure) -> None:
    specs = plan_trials(configure("scenarios=[1]"))
    played = Counter(position for position, _ in play_all(specs, 5, _instant))
    assert played == {0: 1, 1: 1}


@pytest.mark.parametrize("cores", [1, 2, 7])
def test_there_is_a_worker_a_core_where_each_has_enough_to_play(
    cores: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.sched_getaffinity", lambda _: range(cores), raising=False)
    trials = range(10 * WORTH)
    for n in trials:
        assert 1 <= workers_for(n) <= cores
        assert workers_for(n) == 1 or n / workers_for(n) >= WORTH
        assert workers_for(n) == cores or n / (workers_for(n) + 1) < WORTH


@pytest.mark.parametrize(("given", "cores", "used"), [(None, 1, 1), (None, 2, 2), (1, 2, 1)])
def test_a_run_without_a_number_of_workers_chooses_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, given: int | None, cores: int, used: int
) -> None:
    """The choice is for what is missing: a trial that is left over has one worker."""
    monkeypatch.setattr("os.sched_getaffinity", lambda _: range(cores), raising=False)
    monkeypatch.setattr("testbed.experiment.runner.player", _instantly)
    config = load_config("office", ["link=inprocess", "scenarios=[1]", f"limit={WORTH}"])
    assert play_missing(config, tmp_path, given, _ignore).workers == used
    path = tmp_path / "trials.jsonl"
    path.write_bytes(b"".join(path.read_bytes().splitlines(keepends=True)[1:]))
    assert play_missing(config, tmp_path, None, _ignore).workers == 1
    assert len(list(read_records(tmp_path))) == 2 * WORTH


def test_a_caller_that_stops_listening_leaves_no_worker_behind(configure: Configure) -> None:
    specs = plan_trials(configure(*SMALL))
    results = play_all(specs, 2, _instant)
    next(results)
    assert active_children() != []
    results.close()
    assert active_children() == []


def test_an_interrupt_keeps_what_was_finished(tmp_path: Path, configure: Configure) -> None:
    config = configure("scenarios=[1,2]")

    def interrupt(tally: RunStatus) -> None:
        if tally.done == 3 and not tally.interrupted:
            raise KeyboardInterrupt

    tally = play_missing(config, tmp_path, 1, interrupt)
    assert (tally.interrupted, tally.done) == (True, 3)
    assert ids(list(read_records(tmp_path))) == _planned(config)[:3]
    assert len(_run(config, tmp_path)) == 4


def test_a_failed_robot_leaves_its_traceback_and_the_run_goes_on(
    tmp_path: Path, configure: Configure, monkeypatch: pytest.MonkeyPatch
) -> None:
    def make(kind: str) -> Robot:
        if kind == "traditional":
            raise ArithmeticError("out of ideas")
        return make_robot(kind)

    monkeypatch.setattr("testbed.experiment.runner.make_robot", make)
    tally = play_missing(configure("scenarios=[1,2]"), tmp_path, 0, _ignore)
    records = list(read_records(tmp_path))
    outcomes = sorted((record.robot, record.outcome) for record in records)
    assert outcomes == [("intentional", "achieved")] * 2 + [("traditional", "robot_lost")] * 2
    assert tally.failed == 2
    achieved, lost = sorted(records[:2], key=lambda record: record.robot)
    details = (tmp_path / "errors" / f"{lost.trial}.txt").read_text(encoding="utf-8")
    assert details.startswith("Traceback")
    assert "in make" in details
    assert not (tmp_path / "errors" / f"{achieved.trial}.txt").exists()


def test_run_leaves_a_folder_that_can_be_resumed_and_reported(
    tmp_path: Path, configure: Configure
) -> None:
    config, folder = configure("scenarios=[1]"), tmp_path / "run"
    played = run(config, folder, 0)
    assert (played.planned, played.done, played.failed) == (2, 2, 0)
    assert ids(list(read_records(folder))) == _planned(config)
    provenance = json.loads((folder / "provenance.json").read_text("utf-8"))
    assert (provenance["exit"], provenance["end"] is not None) == (0, True)
    assert run(read_config(folder), folder, 0, resume=True).done == 2
    with pytest.raises(StoreError, match="--resume"):
        run(config, folder, 0)


def test_a_run_from_python_refuses_what_a_configuration_names_and_nobody_has(
    tmp_path: Path,
) -> None:
    given = ["robots=[traditional,nobody]", "adversary.strategy=nothing", "limit=1"]
    with pytest.raises(ConfigError) as error:
        run(load_config("quickstart", given), tmp_path / "run", 0)
    first, second = error.value.lines
    assert first.startswith("robots[1]: ")
    assert "nobody" in first
    assert second.startswith("adversary.strategy: ")
    assert "nothing" in second
    assert not (tmp_path / "run").exists()
