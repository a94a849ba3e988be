"""Check a configuration against its domain: every fluent, action, state and scenario in it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager

import asp
from asp import Description
from asp.language import SourceError, atom, check_one_robot, complement, read_domain, suggestion
from asp.reasoning.diagnosis import cannot_hold, never_together
from asp.translation import translate
from testbed.config.levels import ground_findings, grounds, map_findings, settings_findings
from testbed.config.models import GOAL, ExperimentConfig, ScenarioSettings
from testbed.config.places import (
    NO_ROBOT,
    ConfigError,
    Finding,
    Key,
    Places,
    lines_of,
    lines_of_the_domain,
    lines_of_the_map,
    unknown_atom,
    without_left_out,
)
from testbed.config.scenarios import scenario_findings, scenarios_of, script_findings
from testbed.world import StateError, world_of

Check = Callable[[ExperimentConfig], Iterable[Finding]]
"""Finds what is wrong with a configuration for those who use it, such as its robots."""


def check(config: ExperimentConfig, places: Places, checks: Sequence[Check]) -> None:
    """Raise ConfigError with a line for everything in `config` that its domain does not allow.

    `checks` are further ones, which do not need the domain.
    """
    findings = [
        *_twice(config),
        *_compared(config),
        *(found for own in checks for found in own(config)),
    ]
    if config.is_fine:
        lines = [*lines_of(findings, places), *_of_the_levels(config, places)]
    else:
        description = _description(config, places)
        lines = lines_of([*findings, *_coarse_alone(config)], places)
        findings = without_left_out(_domain_findings(config, description), places)
        lines += lines_of_the_domain(config, findings, places, description.scenarios)
    if lines:
        raise ConfigError(lines)


def _of_the_levels(config: ExperimentConfig, places: Places) -> list[str]:
    """Lines at the fine resolution: what all levels have in common, or else what the first has.

    Raises ConfigError for mistakes in the texts of a map.
    """
    if findings := list(settings_findings(config)):
        return lines_of(findings, places)
    with _texts_read(places, "refinement"):
        if config.refinement is not None:
            check_one_robot(*reversed(read_domain(config.domain)))
        if findings := list(map_findings(config)):
            return lines_of(findings, places)
        for _, ground in grounds(config):
            if findings := list(ground_findings(config, ground.refinement)):
                return lines_of_the_map(findings, places)
    return []


def _coarse_alone(config: ExperimentConfig) -> Iterator[Finding]:
    for key in ("level_sizes", "statistics"):
        if getattr(config, key):
            yield (key,), "goes with levels, or with a refinement, and there are none"


def _domain_findings(config: ExperimentConfig, description: Description) -> list[Finding]:
    known = description.scenarios
    findings = [*scenario_findings(config, known), *_observability(config, description)]
    if not description.robots:
        findings.append((("domain",), NO_ROBOT))
    if not config.goal:
        findings.append((("goal",), f"should not be empty; for example {GOAL}"))
    for key, owner in _owners(config, scenarios_of(config, known)):
        findings += _goal((*key, "goal"), owner.goal or (), description)
        findings += _initial((*key, "initial"), owner.initial, description)
        findings += script_findings((*key, "script"), owner.script or (), description)
    return findings


def _description(config: ExperimentConfig, places: Places) -> Description:
    with _texts_read(places, "domain"):
        check_one_robot(*reversed(read_domain(config.domain)))
        return asp.load_description(config.domain)


@contextmanager
def _texts_read(places: Places, key: str) -> Iterator[None]:
    """Mistakes in the texts that a key leads to, as those of the configuration."""
    try:
        yield
    except SourceError as error:
        raise ConfigError([str(mistake) for mistake in error.all]) from None
    except OSError as error:
        raise ConfigError([f"{places.of((key,))}: {error.strerror or error}"]) from None


def _owners(
    config: ExperimentConfig, scenarios: Collection[str]
) -> Iterator[tuple[Key, ExperimentConfig | ScenarioSettings]]:
    """Whose goals, states and scripts are played: settings of other scenarios are left alone."""
    yield (), config
    for scenario, own in config.scenario_settings.items():
        if scenario in scenarios:
            yield ("scenario_settings", scenario), own


def _twice(config: ExperimentConfig) -> Iterator[Finding]:
    for key, names in (
        ("scenarios", config.scenarios),
        ("robots", config.robots),
        ("treatment", config.treatment),
    ):
        for index, name in enumerate(names):
            if name in names[:index]:
                yield (key, index), f"'{name}' is listed twice; keep one of the two"


def _compared(config: ExperimentConfig) -> Iterator[Finding]:
    """Robots are compared that play, and none with itself."""
    named = [(("treatment", index), name) for index, name in enumerate(config.treatment)]
    for key, name in [*((("baseline",), own) for own in [config.baseline] if own), *named]:
        if name not in config.robots:
            yield key, f"'{name}' is none of the robots; {suggestion(name, config.robots)}"
        elif key != ("baseline",) and name == config.baseline:
            yield key, f"'{name}' is the baseline; name another one of the robots"
        elif key == ("baseline",) and len(config.robots) == 1:
            yield key, "compares two robots, and there is one"
    if set(config.robots) <= set(config.treatment):
        yield ("treatment",), "should leave one of the robots as the baseline"


def _observability(config: ExperimentConfig, description: Description) -> Iterator[Finding]:
    known = {action.partition("(")[0] for action in description.exogenous_actions}
    for name in config.observability:
        if name not in known:
            yield ("observability", name), f"no such exogenous action; {suggestion(name, known)}"


def _literals(key: Key, literals: Sequence[str], description: Description) -> Iterator[Finding]:
    fluents = description.fluents
    for index, literal in enumerate(literals):
        if atom(literal) not in fluents:
            yield (*key, index), unknown_atom(atom(literal), fluents, "fluent")
        elif complement(literal) in literals[:index]:
            yield (*key, index), f"contradicts {complement(literal)}; keep one of the two"


def _goal(key: Key, literals: tuple[str, ...], description: Description) -> Iterator[Finding]:
    unknown = list(_literals(key, literals, description))
    yield from unknown
    if not unknown:
        why = _never_together(literals, description)
        if why is not None:
            yield key, f"no state has all of this: {why}"


def _never_together(literals: tuple[str, ...], description: Description) -> str | None:
    """Which literals no state has together: with the law where they follow, else by the theory."""
    try:
        world_of(description).check_together(literals)
    except StateError as error:
        return str(error)
    program = translate(description.source, f"{description.name}.al")
    found = never_together(program, literals)
    return None if found is None else cannot_hold(found)


def _initial(
    key: Key, literals: tuple[str, ...] | None, description: Description
) -> Iterator[Finding]:
    if literals is None:
        return
    unknown = list(_literals(key, literals, description))
    yield from unknown
    if not unknown:
        try:
            world_of(description).state(literals)
        except StateError as error:
            yield key, f"no such initial state: {error}"
