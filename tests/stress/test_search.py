"""The order of a search, and what it finds: the same in any number of processes, and resumed."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from testbed.config import ExperimentConfig
from testbed.experiment.errors import WorkerError
from testbed.experiment.run_folder import read_config, write_config
from testbed.stress.cases import cases_of
from testbed.stress.executors import Here
from testbed.stress.journal import JOURNAL
from testbed.stress.running import Status, search
from testbed.stress.search import Search, results
from testbed.stress.shrinking import Shrunk, shrunk
from testbed.stress.units import Branching, Drawing, Result, Unit
from testbed.world.compiled import CompiledWorld
from tests.stress.domains import DOMAINS, search_in, write_search

UNITS = 40


def _units(config: ExperimentConfig, most: int = UNITS) -> list[tuple[Unit, Result]]:
    found: list[tuple[Unit, Result]] = []
    units = results(Search(config, cases_of(config)), Here(), {}, lambda: len(found) < most)
    found.extend(units)  # one by one: the length says when to stop
    return found


def _silent(_: Status) -> None:
    pass


@pytest.mark.parametrize("domain", DOMAINS)
def test_every_case_is_explored_beside_what_is_promising_and_draws(
    domain: str, tmp_path: Path
) -> None:
    config = search_in(tmp_path, domain, "stress.events=2", "exogenous_while_thinking=true")
    cases, played = cases_of(config), _units(config)
    explored = [unit for unit, _ in played if isinstance(unit, Branching) and not unit.events]
    assert sorted(own.case.trial for own in explored) == sorted(own.trial for own in cases)
    behind = {own.events for _, result in played for own in result.judged[1:] if not own.findings}
    tried = [unit for unit, _ in played if isinstance(unit, Branching) and unit.events]
    assert tried or not behind
    assert {unit.events for unit in tried} <= behind
    assert any(isinstance(unit, Drawing) for unit, _ in played)


def test_more_events_are_tried_before_all_cases_are_explored(tmp_path: Path) -> None:
    config = search_in(tmp_path, "ferry", "limit=null", "stress.events=3")
    assert len(cases_of(config)) > 30
    played = _units(config, 24)
    drawn = [unit for unit, _ in played if isinstance(unit, Drawing)]
    tried = [unit for unit, _ in played if isinstance(unit, Branching) and unit.events]
    assert len(drawn) >= 3
    assert len(tried) >= 3


def test_where_events_have_a_rate_the_likeliest_are_tried_first(tmp_path: Path) -> None:
    rate = ("adversary.strategy=random", "adversary.rate=0.2", "robots=[intentional]")
    config = search_in(tmp_path, "ferry", *rate, "exogenous_while_thinking=true")
    played = _units(config)
    chances = {
        (unit.case.trial, own.events): own.chance
        for unit, result in played
        for own in result.judged
    }
    behind = [unit for unit, _ in played if isinstance(unit, Branching) and unit.events]
    tried = [chances[unit.case.trial, unit.events] for unit in behind]
    assert len(tried) > 3
    assert tried == sorted(tried, key=lambda own: -(own or 0.0))


def test_with_one_event_at_most_and_nothing_drawn_it_ends_by_itself(tmp_path: Path) -> None:
    config = search_in(tmp_path, "garden", "stress.events=1", "stress.minutes=1000")
    status = search(config, tmp_path, 1, _silent)
    assert status.catalogue.units == status.catalogue.cases == status.cases


def test_what_was_played_is_found_again_in_no_time(tmp_path: Path) -> None:
    """With more workers and other minutes, of which nothing is left for anything new."""
    config = search_in(tmp_path, "greenhouse", "stress.events=1", "limit=null")
    whole = search(config, tmp_path, 1, _silent)
    no_time = config.model_copy(
        update={"stress": config.stress.model_copy(update={"minutes": 1e-9})}
    )
    again = search(no_time, tmp_path, 2, _silent)
    assert whole.catalogue.kinds
    assert again.catalogue == whole.catalogue
    assert again.exit_code == 1


@pytest.mark.parametrize("domain", DOMAINS)
def test_what_a_folder_stores_has_the_same_cases(domain: str, tmp_path: Path) -> None:
    config = search_in(tmp_path, domain, "sweep.grid={goal_feedback: [true, false]}")
    (tmp_path / "found").mkdir()
    write_config(tmp_path / "found", config)
    stored = cases_of(read_config(tmp_path / "found"))
    assert [(own.trial, own.seed) for own in stored] == [
        (own.trial, own.seed) for own in cases_of(config)
    ]


def test_a_search_in_which_nothing_is_played_is_no_success(tmp_path: Path) -> None:
    config = search_in(tmp_path, "greenhouse", "stress.minutes=1e-9")
    with pytest.raises(WorkerError, match=r"stress\.minutes"):
        search(config, tmp_path, 1, _silent)


@pytest.mark.parametrize(
    ("strategy", "options", "is_known"),
    [
        ("random", "{}", True),
        ("random", "{delay: 5}", False),
        ("meddler", "{}", False),
        ("null", "{}", False),
    ],
)
def test_probabilities_are_told_of_what_is_drawn_by_a_rate_alone(
    strategy: str, options: str, is_known: bool, tmp_path: Path
) -> None:
    given = [f"adversary.strategy={strategy}", f"adversary.options={options}"]
    config = search_in(tmp_path, "ferry", *given, "adversary.rate=0.2", "stress.events=1")
    chances = {own.chance is not None for _, result in _units(config, 2) for own in result.judged}
    assert chances == {is_known}


def test_what_is_drawn_is_drawn(tmp_path: Path) -> None:
    vary = "stress.vary=[initial, goal, observability, goal_feedback]"
    config = search_in(tmp_path, "ferry", "stress.events=1", vary)
    drawn = [unit.case for unit, _ in _units(config, 60) if isinstance(unit, Drawing)]
    settings = [case.setting for case in drawn]
    assert len({case.initial for case in drawn}) > 3
    assert len({own.goal for own in settings}) > 3
    assert {own.goal_feedback for own in settings} == {True, False}
    modes = {rule.mode for own in settings for rule in own.observability.values()}
    assert modes == {"never", "colocated", "always"}


@pytest.mark.parametrize("runner", [("local", 2), ("dask", 1)])
def test_any_number_of_processes_finds_the_same(runner: tuple[str, int], tmp_path: Path) -> None:
    alone, several = tmp_path / "alone", tmp_path / "several"
    config = search_in(tmp_path, "greenhouse", "stress.events=1", "limit=null")
    for folder, name, workers in ((alone, "local", 1), (several, *runner)):
        folder.mkdir()
        search(config.model_copy(update={"runner": name}), folder, workers, _silent)
    assert (alone / JOURNAL).read_bytes() == (several / JOURNAL).read_bytes()
    told = [json.loads((own / "summary.json").read_text()) for own in (alone, several)]
    assert told[0]["kinds"]
    assert told[0]["with_findings"] == told[1]["with_findings"]


def test_a_search_that_was_killed_goes_on_where_it_was(tmp_path: Path) -> None:
    config = write_search(tmp_path, "greenhouse")
    given = ["stress.events=1", "limit=null"]
    command = [sys.executable, "-m", "testbed", "stress", str(config), *given]
    killed, whole = tmp_path / "killed", tmp_path / "whole"
    process = subprocess.Popen([*command, "--out", str(killed)], start_new_session=True)
    while process.poll() is None and not _lines(killed):
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    with (killed / JOURNAL).open("ab") as journal:
        journal.write(b'{"unit": "torn')
    for folder, more in ((killed, ["--resume"]), (whole, [])):
        done = subprocess.run([*command, "--out", str(folder), *more], capture_output=True)
        assert done.returncode == 1, done.stderr
    assert _lines(killed) == _lines(whole)
    stories = [[own.name for own in sorted(each.glob("story-*"))] for each in (killed, whole)]
    assert stories[0] == stories[1] != []


def _lines(folder: Path) -> Sequence[bytes]:
    journal = folder / JOURNAL
    return journal.read_bytes().splitlines(keepends=True) if journal.exists() else []


@pytest.mark.parametrize("domain", ["ferry", "greenhouse"])
def test_a_story_is_shrunk_to_one_with_the_same_finding(
    domain: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without a list of all states, of which there may be too many."""
    config = search_in(tmp_path, domain, "limit=null", "robots=[traditional]")
    cases_of(config)
    monkeypatch.delattr(CompiledWorld, "states")
    found = 0
    for unit, result in _units(config):
        for own in result.judged:
            for finding in own.findings[:1]:
                found += 1
                once = shrunk(config.seed, unit.case, own.events, config.stress, finding)
                assert _kind(once) == (finding.objective, finding.rule)
                assert len(once.events) <= len(own.events)
                assert once == shrunk(
                    config.seed, once.case, once.events, config.stress, once.finding
                )
        if found > 4:
            break
    assert found


def _kind(story: Shrunk) -> tuple[str, str]:
    return story.finding.objective, story.finding.rule
