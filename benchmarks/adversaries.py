"""What adversaries with the same budget cost robots, from the same initial states."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from benchmarks.sheets import DisagreementError, Row, Sheet, gathered
from testbed.analysis.statistics import signed_rank
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

ROBOTS = ("traditional", "intentional")
BASELINE = "random"
STRATEGIES = (BASELINE, "meddler", "belief", "greedy", "optimal")
RATED = {BASELINE: "adversary.rate=0.3"}
"""How often: of the others an event happens wherever it is worth anything."""
TRIALS, BUDGET = {"small": 2, "full": 20}, {"small": 1, "full": 2}


def main(size: str) -> list[Sheet]:
    """Sheet `adversaries`. Raises DisagreementError where one costs more than the optimal one."""
    notes = (
        f"office, scenario 1 without its triggers, fair events, a budget of {BUDGET[size]};",
        "units: those of all attempts; extra: beyond the optimum without events; p and effect:",
        f"signed ranks of units against those of {BASELINE} from the same state, not corrected",
    )
    rows = gathered(_rows(TRIALS[size], BUDGET[size]))
    return [Sheet("adversaries", "Execution units that adversaries cost robots", rows, notes)]


def _rows(trials: int, budget: int) -> Iterator[Row]:
    for robot in ROBOTS:
        records = {name: _played(robot, name, trials, budget) for name in STRATEGIES}
        _check_bound(robot, records)
        baseline = _units(records[BASELINE])
        for name, own in records.items():
            units = _units(own)
            least = np.array([record.minimal_units or 0 for record in own], float)
            test = signed_rank(units - baseline)
            yield {
                "robot": robot,
                "strategy": name,
                "trials": len(own),
                "achieved": sum(record.achieved for record in own),
                "events": float(np.mean([len(record.exogenous) for record in own])),
                "units": float(units.mean()),
                "extra": float((units - least).mean()),
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
        f"adversary.strategy={strategy}",
        *([RATED[strategy]] if strategy in RATED else []),
    ]
    client = InProcessRobot(make_robot)
    return [play_trial(spec, client).record for spec in plan_trials(load_config("office", given))]


def _units(records: Sequence[TrialRecord]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.array([record.execution_units for record in records], float)


def _check_bound(robot: str, records: Mapping[str, Sequence[TrialRecord]]) -> None:
    """Both are deterministic: from no state does any strategy cost more than the optimal one."""
    most = _units(records["optimal"])
    for name, own in records.items():
        if (_units(own) > most).any():
            raise DisagreementError(f"{name} costs {robot} more than optimal")
