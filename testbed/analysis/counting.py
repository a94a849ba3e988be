"""Which pairs a comparison counts, and why it counts the others apart."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

from testbed.config import ExperimentConfig
from testbed.experiment.domains import load_world
from testbed.experiment.record import TrialRecord

BASELINE, INTENTIONAL = "traditional", "intentional"
"""The robots that a summary compares."""

Apart: TypeAlias = Literal[
    "incomplete", "lost", "deadline", "unsolvable", "nothing to do", "no event"
]
NOTHING_TO_DO: Apart = "nothing to do"
NO_EVENT: Apart = "no event"
DEADLINE: Apart = "deadline"
CERTAIN = 1.0


@dataclass(frozen=True, slots=True)
class Standing:
    """What decides of a trial whether its pair counts.

    `lost`: something other than its robot ended it; `late`: a decision was cut off by the clock;
    `solvable`: some plan achieves the goal from the initial state; `idle`: the goal held from there
    on; `quiet`: nothing exogenous happened. Of a trial that the robot's own error ended it is not
    known what it would have been: it is neither.
    """

    lost: bool
    late: bool
    solvable: bool
    idle: bool
    quiet: bool


def standing(record: TrialRecord) -> Standing:
    """That of a trial on record."""
    return Standing(
        lost=record.lost,
        late=record.deadline,
        solvable=is_solvable(record),
        idle=is_idle(record),
        quiet=not record.exogenous and not record.failed,
    )


def is_solvable(record: TrialRecord) -> bool:
    """Whether some plan achieves the goal from the initial state, or none is known not to."""
    return record.minimal_actions is not None or record.minimal_reason == "budget"


def is_idle(record: TrialRecord) -> bool:
    """Whether there was nothing to do: no activity, no action, and the goal holds."""
    acted = record.activities or record.actions
    return record.achieved and not acted and not record.failed


def eventful(config: ExperimentConfig) -> frozenset[str]:
    """The scenarios in which something exogenous is to happen: a pair without it is not theirs.

    These are the scenarios with a script that is not empty, and those with a trigger that the
    domain does not leave to chance; in one that it does, nothing is among what may happen.
    """
    if config.is_fine:
        return frozenset()
    triggers = load_world(config.domain).description.triggers
    certain = {trigger.scenario for trigger in triggers if trigger.probability == CERTAIN}
    sure: set[str] = certain if config.plays_triggers else set()
    scripts = {name: config.settings(name).script for name in config.scenarios}
    return frozenset(
        n for n, script in scripts.items() if (n in sure if script is None else script)
    )


def compared(robots: Collection[str]) -> tuple[str, ...]:
    """Whose trials a pair of a run must have: the robots that are compared, else all of them."""
    known = tuple(name for name in (BASELINE, INTENTIONAL) if name in robots)
    return known or tuple(robots)


def why_apart(
    scenario: str,
    needed: Collection[Standing | None],
    judges: Collection[Standing],
    sure: Collection[str],
) -> Apart | None:
    """Why a pair is in no comparison; None if it is in it.

    `needed` are the trials that are compared, None for one that is missing; `judges` those that say
    whether there was something to do, and whether the event fired; `sure` the eventful scenarios.
    """
    known = [own for own in needed if own is not None]
    if len(known) < len(needed):
        return "incomplete"
    if any(own.lost for own in known):
        return "lost"
    if any(own.late for own in known):
        return DEADLINE
    if not all(own.solvable for own in known):
        return "unsolvable"
    if all(own.idle for own in judges):
        return NOTHING_TO_DO
    quiet = all(own.quiet for own in judges)
    return NO_EVENT if quiet and scenario in sure else None


def pair_apart(
    scenario: str, trials: Mapping[str, Standing], robots: Collection[str], sure: Collection[str]
) -> Apart | None:
    """The same of the trials of a pair by robot, in a run of these robots.

    The intentional robot's trial judges, where it is there: others see the same events only as
    long as they act like it.
    """
    needed = [trials.get(name) for name in compared(robots)]
    judges = [trials[INTENTIONAL]] if INTENTIONAL in trials else list(trials.values())
    return why_apart(scenario, needed, judges, sure)


def pairs_apart(records: Iterable[TrialRecord], sure: Collection[str]) -> dict[str, Apart]:
    """The pairs that do not count, by their ids."""
    scenarios: dict[str, str] = {}
    pairs: dict[str, dict[str, Standing]] = {}
    for record in records:
        scenarios[record.pair] = record.scenario
        pairs.setdefault(record.pair, {})[record.robot] = standing(record)
    robots = dict.fromkeys(robot for trials in pairs.values() for robot in trials)
    reasons = ((pair, pair_apart(scenarios[pair], t, robots, sure)) for pair, t in pairs.items())
    return {pair: reason for pair, reason in reasons if reason is not None}
