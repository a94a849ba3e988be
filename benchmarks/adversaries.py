"""What adversaries with the same budget cost robots, from the same initial states."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from asp.language import Literal
from benchmarks.sheets import DisagreementError, Row, Sheet, gathered
from testbed.analysis.bootstrap import Values, bootstrap, means, sample_of
from testbed.analysis.statistics import signed_rank
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

ROBOTS = ("traditional", "intentional")
BASELINE = "random"
STRATEGIES: Mapping[str, Sequence[str]] = {
    BASELINE: ["adversary.strategy=random", "adversary.rate=0.3"],
    "random, rate 1": ["adversary.strategy=random", "adversary.rate=1"],
    "meddler": ["adversary.strategy=meddler"],
    "belief": ["adversary.strategy=belief"],
    "greedy": ["adversary.strategy=greedy"],
    "learned": ["adversary.strategy=learned", "adversary.options={{policy: office-{robot}}}"],
    "optimal": ["adversary.strategy=optimal"],
}
"""Of those without a rate an event happens wherever it is worth anything."""
Start = tuple[Literal, ...]
TRIALS, BUDGET = {"small": 3, "full": 96}, {"small": 1, "full": 2}
BOUNDED = {"small": 2, "full": 20}
"""Of these states those from which the optimal one plays, which takes long."""


def main(size: str) -> list[Sheet]:
    """Sheet `adversaries`. Raises DisagreementError where one costs more than the optimal one."""
    notes = (
        f"office, scenario 1 without its triggers, fair events, a budget of {BUDGET[size]};",
        "units: those of all attempts; shared: of the trials from the states of optimal alone;",
        f"extra: beyond the optimum without events; more: than {BASELINE} from the same state,",
        "with its 95% bootstrap interval; p and effect: signed ranks of that, not corrected",
    )
    rows = gathered(_rows(TRIALS[size], BOUNDED[size], BUDGET[size]))
    return [Sheet("adversaries", "Execution units that adversaries cost robots", rows, notes)]


def _rows(trials: int, bounded: int, budget: int) -> Iterator[Row]:
    for robot in ROBOTS:
        records = {
            name: _played(robot, name, bounded if name == "optimal" else trials, budget)
            for name in STRATEGIES
        }
        units = {name: _units(own) for name, own in records.items()}
        check_bound(robot, units)
        for name, own in records.items():
            more = _differences(units[name], units[BASELINE])
            test, mean = signed_rank(more), bootstrap(means, sample_of(more))
            assert mean is not None, "trials were played"
            yield {
                "robot": robot,
                "strategy": name,
                "trials": len(own),
                "achieved": sum(record.achieved for record in own),
                "events": float(np.mean([len(record.exogenous) for record in own])),
                "units": float(np.mean([*units[name].values()])),
                "shared": float(np.mean([units[name][start] for start in units["optimal"]])),
                "extra": float(np.mean([_extra(record) for record in own])),
                "more": mean.value,
                "low": mean.low,
                "high": mean.high,
                "p": None if test is None else test.p,
                "effect": None if test is None else test.effect,
            }


def _played(robot: str, strategy: str, trials: int, budget: int) -> list[TrialRecord]:
    given = [
        "scenarios=[1]",
        f"robots=[{robot}]",
        f"limit={trials}",
        f"adversary.budget={budget}",
        "adversary.fair=true",
        *(given.format(robot=robot) for given in STRATEGIES[strategy]),
    ]
    client = InProcessRobot(make_robot)
    return [play_trial(spec, client).record for spec in plan_trials(load_config("office", given))]


def _units(records: Sequence[TrialRecord]) -> dict[Start, int]:
    return {tuple(record.initial): record.execution_units for record in records}


def _extra(record: TrialRecord) -> int:
    return record.execution_units - (record.minimal_units or 0)


def _differences(units: Mapping[Start, int], others: Mapping[Start, int]) -> Values:
    """From each state that both play from."""
    return np.array([own - others[start] for start, own in units.items()], float)


def check_bound(robot: str, units: Mapping[str, Mapping[Start, int]]) -> None:
    """Both are deterministic: from no state does any strategy cost more than the optimal one."""
    for name, own in units.items():
        if (_differences(units["optimal"], own) < 0).any():
            raise DisagreementError(f"{name} costs {robot} more than optimal")
