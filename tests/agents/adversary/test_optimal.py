"""The optimal adversary against all scripts, played one by one as trials, in small domains."""

from collections.abc import Iterator
from itertools import product
from pathlib import Path

import msgspec
import pytest
from typer.testing import CliRunner

from asp.language import Action
from testbed.cli import app
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.world import load_world
from tests.stress.domains import DOMAINS, search_in, write_search

Script = tuple[tuple[int, Action], ...]


def _played(spec: TrialSpec, **changes: object) -> TrialRecord:
    setting = msgspec.structs.replace(spec.setting, **changes)
    spec = msgspec.structs.replace(spec, setting=setting)
    return play_trial(spec, InProcessRobot(make_robot)).record


def _scripts(spec: TrialSpec, budget: int) -> Iterator[TrialRecord]:
    """The trials with every script of at most so many events; what is not legal is left out."""
    events = load_world(spec.setting.domain).exogenous_actions

    def played(script: Script) -> TrialRecord:
        return _played(spec, script=script, script_skips=True, strategy=None, options=None)

    def behind(script: Script, last: int) -> Iterator[TrialRecord]:
        record = played(script)
        if len(record.exogenous) < len(script):
            return  # the last one was not legal
        yield record
        if len(script) < budget:
            for step, event in product(range(last + 1, record.steps + 1), events):
                yield from behind((*script, (step, event)), step)

    yield from behind((), 0)


@pytest.mark.parametrize("robot", ["traditional", "intentional"])
@pytest.mark.parametrize(("domain", "budget"), [*((own, 1) for own in DOMAINS), ("greenhouse", 2)])
@pytest.mark.parametrize("measure", ["units", "fail"])
def test_no_script_is_worth_more(
    measure: str, domain: str, budget: int, robot: str, tmp_path: Path
) -> None:
    config = search_in(
        tmp_path,
        domain,
        f"robots=[{robot}]",
        f"adversary.budget={budget}",
        "adversary.strategy=optimal",
        f"adversary.options={{measure: {measure}}}",
        "adversary.fair=true",
        "limits.steps=12",
        "limit=2",
    )
    for spec in plan_trials(config):
        record = _played(spec)
        assert record.outcome not in ("error", "robot_lost"), record.reason
        most = max(_worth(own, measure) for own in _scripts(spec, budget))
        assert _worth(record, measure) == most


def _worth(record: TrialRecord, measure: str) -> tuple[bool, int]:
    return measure == "fail" and record.outcome != "achieved", record.execution_units


@pytest.mark.parametrize("strategy", ["random", "meddler", "belief", "greedy"])
@pytest.mark.parametrize("robot", ["traditional", "intentional"])
def test_no_other_strategy_costs_more_units(strategy: str, robot: str, tmp_path: Path) -> None:
    given = (f"robots=[{robot}]", "adversary.budget=2", "adversary.fair=true", "limit=4")
    best, other = (
        plan_trials(search_in(tmp_path, "ferry", *given, f"adversary.strategy={name}"))
        for name in ("optimal", strategy)
    )
    for first, second in zip(best, other, strict=True):
        assert first.initial == second.initial
        assert _played(first).execution_units >= _played(second).execution_units


def test_with_few_episodes_it_takes_the_best_of_them(tmp_path: Path) -> None:
    given = ("robots=[traditional]", "adversary.budget=1", "adversary.strategy=optimal")
    for episodes in (1, 3, 1000):
        options = f"adversary.options={{episodes: {episodes}}}"
        (spec, *_) = plan_trials(search_in(tmp_path, "greenhouse", *given, options))
        record = _played(spec)
        assert record.outcome not in ("error", "robot_lost")
        assert (len(record.exogenous) == 0) or episodes > 1


@pytest.mark.parametrize(
    ("given", "parts"),
    [
        ("{strategy: optimal}", ["adversary.budget"]),
        (
            "{strategy: optimal, budget: 1, options: {episodes: 0}}",
            ["adversary.options", "episodes"],
        ),
        ("{strategy: optimal, budget: 1, options: {measure: fun}}", ["options.measure", "fun"]),
    ],
)
def test_what_it_cannot_do_without_is_said_in_one_line(
    given: str, parts: list[str], tmp_path: Path
) -> None:
    config = write_search(tmp_path, "greenhouse")
    done = CliRunner().invoke(app, ["run", str(config), f"adversary={given}", "--quiet"])
    (line,) = done.stderr.splitlines()
    assert done.exit_code == 2
    assert all(part in line for part in parts), line
