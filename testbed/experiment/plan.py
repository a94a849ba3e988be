"""From a configuration to the list of its trials, before anything runs."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import msgspec

from asp.language import Description, Literal, Trigger
from asp.reasoning.determinism import deterministic_by_form
from asp.refinement import Refinement
from testbed.config import (
    NO_EVENTS,
    ExperimentConfig,
    Finding,
    conditions_of,
    level_size,
    refinements,
)
from testbed.environment import RandomGoal, RandomStart
from testbed.experiment.record import COARSE
from testbed.experiment.seeds import drawn_part, generator_of
from testbed.experiment.specs import FineSetting, TrialSpec, pair_specs, setting_of
from testbed.experiment.store import read_records
from testbed.experiment.timeline import place
from testbed.text import listed
from testbed.world import World, load_world, world_of

Atoms = tuple[Literal, ...]
SCENARIO = "levels"
"""What stands in place of a scenario in the records of trials at the fine resolution."""


def plan_trials(config: ExperimentConfig) -> list[TrialSpec]:
    """The trials of a configuration in their order: condition, scenario or level, pair, robot."""
    return list(trials_of(config))


def trials_of(config: ExperimentConfig) -> Iterator[TrialSpec]:
    """The same, one at a time."""
    for cell, own in conditions_of(config).items():
        for spec in (_at_levels if own.is_fine else _in_scenarios)(own):
            yield msgspec.structs.replace(spec, cell=cell) if config.is_sweep else spec


def sweep_findings(config: ExperimentConfig) -> Iterator[Finding]:
    """Conditions of a sweep under which the same trials are played."""
    first: dict[bytes, str] = {}
    for cell, own in conditions_of(config).items():
        scenarios = own.scenarios or (SCENARIO,)
        rules = [[setting_of(own, name), own.settings(name).initial] for name in scenarios]
        known = first.setdefault(msgspec.json.encode(rules, enc_hook=str, order="sorted"), cell)
        if known != cell:
            yield ("sweep",), f"'{known}' and '{cell}' are the same condition; keep one of the two"


def planned_trials(config: ExperimentConfig) -> dict[str, int]:
    """How many trials each scenario, or level, has in the plan, without drawing what they are."""
    if config.is_sweep:
        counts = map(planned_trials, conditions_of(config).values())
        return dict(sum(map(Counter, counts), Counter()))
    robots = len(config.robots)
    if config.is_fine:
        own = [Path(config.refinement).stem] if config.refinement else []
        return dict.fromkeys((*own, *config.levels), (config.limit or 0) * robots)
    world = load_world(config.domain)
    return {name: len(list(_starts(config, name, world))) * robots for name in config.scenarios}


def enumerated(config: ExperimentConfig) -> dict[str, int]:
    """How many trials the scenarios have in the plan that are a whole population and no sample.

    They are played from every initial state of the domain, and nothing in them is drawn.
    """
    if config.is_fine:
        return {}
    world = load_world(config.domain)
    names = [
        name
        for name in config.scenarios
        if config.settings(name).initial is None and not _is_drawn(config, name, world.description)
    ]
    states = len(world.initial_states()) if names else 0
    if config.limit is not None and config.limit < states:
        return {}
    return dict.fromkeys(names, states * len(config.robots))


def _in_scenarios(config: ExperimentConfig) -> Iterator[TrialSpec]:
    world = load_world(config.domain)
    domain = world.description.name
    for scenario in config.scenarios:
        setting = setting_of(config, scenario)
        for initial, repeat in _starts(config, scenario, world):
            start = [domain, COARSE, scenario, list(initial), sorted(setting.goal)]
            path = [*start, repeat] if repeat else start
            yield from pair_specs(config, scenario, COARSE, path, initial, setting, domain)


def _starts(config: ExperimentConfig, scenario: str, world: World) -> Iterator[tuple[Atoms, int]]:
    """Initial states, and which of the pairs from there this is, from 0 on."""
    given = config.settings(scenario).initial
    states = world.initial_states() if given is None else [world.state(given)]
    repeats = _repeats(config, scenario, world.description)
    drawn = drawn_part(len(states) * repeats, config.limit, config.seed, scenario)
    return ((_atoms(world, states[index // repeats]), index % repeats) for index in drawn)


@lru_cache(maxsize=10_000)
def _atoms(world: World, state: int) -> Atoms:
    """The true atoms of a state, which starts many trials."""
    return tuple(sorted(world.true_atoms(state)))


def _repeats(config: ExperimentConfig, scenario: str, description: Description) -> int:
    """Pairs from each initial state of a scenario.

    Where nothing is left open to a seed, another pair would be the same trial again.
    """
    drawn = _is_drawn(config, scenario, description)
    return config.settings(scenario).repeats or 1 if drawn else 1


def _is_drawn(config: ExperimentConfig, scenario: str, description: Description) -> bool:
    """Whether a seed draws what others do, what is told of it, or an action's outcome."""
    triggers = [t for t in description.triggers if t.scenario == scenario]
    events = config.settings(scenario).script is None and _events_are_drawn(config, triggers)
    return events or _news_is_drawn(config) or not deterministic_by_form(description)


def _events_are_drawn(config: ExperimentConfig, triggers: Sequence[Trigger]) -> bool:
    rate = config.adversary.rate
    if not config.plays_triggers:
        return rate != 0 and config.adversary.strategy != NO_EVENTS
    return any(t.drawings or _open(t.probability if rate is None else rate) for t in triggers)


def _news_is_drawn(config: ExperimentConfig) -> bool:
    rules = config.observability.values()
    return any(_open(own.probability) or own.false_reports > 0 for own in rules)


def _open(probability: float) -> bool:
    return 0.0 < probability < 1.0


def _at_levels(config: ExperimentConfig) -> Iterator[TrialSpec]:
    domain, common = Path(config.domain).stem, setting_of(config, SCENARIO)
    for level, refinement in refinements(config):
        fine = FineSetting(
            size=None if config.refinement else level_size(config, level),
            refinement=config.refinement,
            statistics=dict(sorted(config.statistics.items())),
            pace=config.adversary.pace,
        )
        texts = [refinement.coarse.text, refinement.text] if config.refinement else []
        for path, initial, goal in _drawn(config, refinement, (level, *texts)):
            setting = msgspec.structs.replace(common, goal=goal, fine=fine)
            yield from pair_specs(config, SCENARIO, level, path, initial, setting, domain)


def _drawn(
    config: ExperimentConfig, refinement: Refinement, place: Sequence[str]
) -> Iterator[tuple[list[object], Atoms, Atoms]]:
    """The pairs of a level: their seed paths, the inertial atoms true at first, and goals.

    A goal does not hold at first. What the configuration gives is not drawn.
    """
    world, description = world_of(refinement), refinement.description
    start = RandomStart(world, description.robots[0], config.draw.holding)
    goals = None if config.goal else RandomGoal(world, config.draw.goal, description.sorts)
    for number in range(1, (config.limit or 0) + 1):
        generator = generator_of(config.seed, [*place, number])
        state = start(generator) if config.initial is None else world.state(config.initial)
        inertial = frozenset(world.true_atoms(state)).intersection(world.description.inertial)
        initial = tuple(sorted(inertial))
        goal = config.goal if goals is None else goals(state, generator)
        yield [*place, number, list(initial), sorted(goal)], initial, goal


@dataclass(frozen=True)
class Coverage:
    """Trials planned and on record, by scenario or level; `noun` is which of both."""

    noun: str
    planned: Mapping[str, int]
    on_record: Mapping[str, int]

    @property
    def missing(self) -> dict[str, int]:
        """How many trials are not on record, of what lacks any, in the order of the plan."""
        lacking = {name: n - self.on_record.get(name, 0) for name, n in self.planned.items()}
        return {name: number for name, number in lacking.items() if number > 0}

    def numbers(self) -> dict[str, object]:
        """The part of `summary.json`: all that were planned, and what is missing."""
        return {"planned": sum(self.planned.values()), "missing": self.missing}

    def notice(self) -> str | None:
        """What a reader has to know of a run that is not complete; None of one that is."""
        missing = self.missing
        if not missing:
            return None
        planned = sum(self.planned.values())
        head = f"{planned - sum(missing.values())} of {planned} trials are on record"
        untouched = [name for name, number in missing.items() if number == self.planned[name]]
        parts = [self._begun(name, n) for name, n in missing.items() if name not in untouched]
        if untouched:
            names = self.noun if len(untouched) == 1 else f"{self.noun}s"
            parts.append(f"none of {names} {listed(untouched)}")
        return f"{head}: {', '.join(parts)}"

    def _begun(self, name: str, missing: int) -> str:
        planned = self.planned[name]
        return f"{planned - missing} of {planned} of {self.noun} {name}"


def places_of(folder: Path) -> Iterator[tuple[str, str]]:
    """Scenario and level of each trial on record in a run folder. Raises StoreError."""
    return ((record.scenario, record.level) for record in read_records(folder))


def coverage_of(trials: Iterable[tuple[str, str]], config: ExperimentConfig) -> Coverage:
    """How much of the plan of a configuration these trials are: scenario and level of each."""
    on_record = Counter(place(scenario, level) for scenario, level in trials)
    noun = "level" if config.is_fine else "scenario"
    return Coverage(noun, planned_trials(config), on_record)
