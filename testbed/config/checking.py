"""Check a configuration against its domain: every fluent, action, state and scenario in it."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

from asp.language import (
    Description,
    Literal,
    Signature,
    SourceError,
    analyse,
    check_one_robot,
    parse_description,
    read_domain,
    suggestion,
)
from asp.reasoning.diagnosis import cannot_hold, never_together
from asp.refinement import Refinement
from asp.translation import translate
from testbed.config.game import event_findings
from testbed.config.levels import map_findings, refinements, settings_findings
from testbed.config.models import GOAL, ExperimentConfig
from testbed.config.places import ConfigError, Diction, Finding, Key, Places, dotted, unfit_literals
from testbed.config.running import runner_findings
from testbed.config.scenarios import (
    refused_script_findings,
    scenario_findings,
    scenarios_of,
    script_findings,
)
from testbed.config.sections import Drawing, ScenarioSettings
from testbed.config.values import NONE
from testbed.world import StateError, World, world_of

Check = Callable[[ExperimentConfig], Iterable[Finding]]
"""Finds what is wrong with a configuration for those who use it, such as its robots."""

NO_ROBOT = (
    "has no robot: nobody sees anything in it; "
    "in its section 'sees' write for example: R sees f(X) if robot(R)."
)
"""What is wrong with a domain without `sees`: the robot is the one that sees."""
OF_THE_DOMAIN = ("goal", "initial", "scenarios", "scenario_settings", "script", "observability")
"""What is said in the words of a domain."""


def check(config: ExperimentConfig, places: Places, checks: Sequence[Check]) -> None:
    """Raise ConfigError with a line for everything in `config` that its domain does not allow.

    `checks` are further ones, which do not need the domain.
    """
    findings = [
        found for own in (_twice, _compared, runner_findings, *checks) for found in own(config)
    ]
    if config.is_fine:
        lines = places.lines(findings) + _of_the_levels(config, places)
    else:
        with _texts_read(places, "domain"):
            file, text = read_domain(config.domain)
            check_one_robot(text, file)
        description, (_, signature) = parse_description(text, file), analyse(text, file)
        alone = "goes with levels, or with a refinement, and there are none"
        fine = [key for key in ("level_sizes", "statistics") if getattr(config, key)]
        lines = places.lines([*findings, *(((key,), alone) for key in fine)])
        lines += _of_the_domain(config, places, description, signature)
    if lines:
        raise ConfigError(lines)


def _of_the_levels(config: ExperimentConfig, places: Places) -> list[str]:
    """Lines at the fine resolution: what all levels have in common, or else what the first has.

    Raises ConfigError for mistakes in the texts of a map.
    """
    if findings := list(settings_findings(config)):
        return places.lines(findings)
    with _texts_read(places, "refinement"):
        if config.refinement is not None:
            check_one_robot(*reversed(read_domain(config.domain)))
        if findings := list(map_findings(config)):
            return places.lines(findings)
        for _, refinement in refinements(config):
            if findings := list(_level_findings(config, refinement)):
                foreign = {
                    dotted(key[:2]) if key[0] == "draw" else str(key[0]): message.partition(";")[0]
                    for key, message in reversed(findings)
                    if not places.is_overridden(key)
                }
                wanted = [f"{key} ({why})" for key, why in reversed(foreign.items())]
                return places.lines_of_another("refinement", wanted, findings)
    return []


@contextmanager
def _texts_read(places: Places, key: str) -> Iterator[None]:
    """Mistakes in the texts that a key leads to, as those of the configuration."""
    try:
        yield
    except SourceError as error:
        raise ConfigError([str(mistake) for mistake in error.all]) from None
    except OSError as error:
        raise ConfigError([f"{places.of((key,))}: {error.strerror or error}"]) from None


def _of_the_domain(
    config: ExperimentConfig, places: Places, description: Description, signature: Signature
) -> list[str]:
    """Lines of what the domain does not know.

    Scenarios that the file has settings of need not be known where others are played instead.
    """
    others_played = places.is_overridden(("scenarios",))
    findings = [
        (key, message)
        for key, message in _domain_findings(config, description, signature)
        if not (others_played and key[0] == "scenario_settings" and len(key) == 2)
        or places.is_overridden(key)
    ]
    # What would fit this domain by chance is named, too: it was not meant for it.
    written = [key for key in OF_THE_DOMAIN if _is_written(key, config)]
    foreign = {key: key for key in written if not places.is_overridden((key,))}
    if "scenarios" in foreign and not description.scenarios:
        foreign["scenarios"] += f" (it has none: {NONE})"
    return places.lines_of_another("domain", foreign.values(), findings)


def _is_written(key: str, config: ExperimentConfig) -> bool:
    """Whether the configuration says something; settings of a scenario left out say nothing."""
    if key == "scenario_settings" and config.scenarios:
        return not config.scenario_settings.keys().isdisjoint(config.scenarios)
    return bool(getattr(config, key))


def _domain_findings(
    config: ExperimentConfig, description: Description, signature: Signature
) -> Iterator[Finding]:
    """What a domain does not allow."""
    known, world = description.scenarios, world_of(description)
    yield from scenario_findings(config, known)
    why = "no such exogenous action"
    yield from _names(("observability",), config.observability, signature, "exogenous", why)
    if not description.robots:
        yield ("domain",), NO_ROBOT
    if config.initial is None:
        try:
            world.check_begins()
        except StateError as error:
            yield ("domain",), str(error)
    if not config.goal:
        yield ("goal",), f"should not be empty; for example {GOAL}"
    wrong_events = [*event_findings(config.adversary, signature)]
    yield from wrong_events
    goals, states = goals_of(world, signature), Diction(signature, world.state)
    yield from _said((), config, goals, states)
    played = scenarios_of(config, known)
    if not wrong_events:  # else scripts are not what is wrong
        yield from refused_script_findings(config, played)
    for scenario, own in config.scenario_settings.items():
        if scenario in played:  # what is said of others is left alone
            yield from _said(("scenario_settings", scenario), own, goals, states)


def goals_of(world: World, signature: Signature) -> Diction:
    """What goals of a domain are given in."""
    return Diction(signature, partial(_check_goal, world))


def _check_goal(world: World, literals: Sequence[Literal]) -> None:
    """Raises StateError for literals that no state has: with a law, else by the theory."""
    world.check_together(literals)
    description = world.description
    program = translate(description.source, f"{description.name}.al")
    found = never_together(program, literals)
    if found is not None:
        raise StateError(cannot_hold(found))


def _level_findings(config: ExperimentConfig, refinement: Refinement) -> Iterator[Finding]:
    """What the descriptions of one level do not allow."""
    coarse, weak = refinement.coarse_signature, refinement.weak_signature
    if not refinement.description.robots:
        yield ("domain",), NO_ROBOT
    if not config.goal:
        yield from _drawn_findings(config.draw, coarse)
    why = "no such action at this resolution"
    yield from _names(("observability",), config.observability, weak, "exogenous", why)
    yield from _names(("statistics",), config.statistics, refinement.strong_signature, "agent", why)
    wrong_events = [*event_findings(config.adversary, weak)]
    yield from wrong_events
    goals = Diction(coarse, lambda given: world_of(refinement.description).check_together(given))
    states = Diction(weak, lambda given: world_of(refinement).state(given))
    yield from _said((), config, goals, states)
    if not wrong_events:  # else scripts are not what is wrong
        yield from refused_script_findings(config, ())


def _drawn_findings(draw: Drawing, signature: Signature) -> Iterator[Finding]:
    """What is wrong with the goal that is drawn; in one line, where it is the one by default."""
    instead_of_constants = {sort: (sort, *signature.sorts) for sort in signature.sorts}
    patterns = Diction(replace(signature, sorts=instead_of_constants), lambda _: None)
    findings = list(unfit_literals(("draw", "goal"), draw.goal, patterns, ""))
    if findings and "goal" not in draw.model_fields_set:
        why, sorts = findings[0][1].partition(";")[0], ", ".join(signature.sorts)
        by_default = f"is by default {', '.join(draw.goal)}, which does not fit this domain: {why}"
        findings = [(("draw", "goal"), f"{by_default}; give a goal with its sorts: {sorts}")]
    yield from findings


def goal_findings(key: Key, goal: Sequence[Literal] | None, goals: Diction) -> Iterator[Finding]:
    """What is wrong with a goal; nothing, where none is given."""
    yield from unfit_literals(key, goal or None, goals, "no state has all of this")


def _said(
    key: Key, owner: ExperimentConfig | ScenarioSettings, goals: Diction, states: Diction
) -> Iterator[Finding]:
    """What is wrong with a goal, an initial state, and a script."""
    yield from goal_findings((*key, "goal"), owner.goal, goals)
    yield from unfit_literals((*key, "initial"), owner.initial, states, "no such initial state")
    yield from script_findings((*key, "script"), owner.script or (), states.signature)


def _names(
    key: Key, given: Iterable[str], signature: Signature, kind: str, why: str
) -> Iterator[Finding]:
    """Names that are none of the actions of a kind."""
    known = [name for name, symbol in signature.symbols.items() if symbol.kind == kind]
    for name in given:
        if name not in known:
            yield (*key, name), f"{why}; {suggestion(name, known)}"


def _twice(config: ExperimentConfig) -> Iterator[Finding]:
    for key in ("scenarios", "levels", "robots", "treatment"):
        names = getattr(config, key)
        for index, name in enumerate(names):
            if name in names[:index]:
                yield (key, index), f"'{name}' is listed twice; keep one of the two"


def _compared(config: ExperimentConfig) -> Iterator[Finding]:
    """Robots are compared that play, and none with itself."""
    named: list[tuple[Key, str]] = [(("baseline",), config.baseline)] if config.baseline else []
    named += [(("treatment", index), name) for index, name in enumerate(config.treatment)]
    for key, name in named:
        if name not in config.robots:
            yield key, f"'{name}' is none of the robots; {suggestion(name, config.robots)}"
        elif key != ("baseline",) and name == config.baseline:
            yield key, f"'{name}' is the baseline; name another one of the robots"
        elif key == ("baseline",) and len(config.robots) == 1:
            yield key, "compares two robots, and there is one"
    if set(config.robots) <= set(config.treatment):
        yield ("treatment",), "should leave one of the robots as the baseline"
