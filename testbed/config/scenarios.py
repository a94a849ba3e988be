"""Check which scenarios a configuration plays, and its scripts: what they name, and when."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from asp.language import Signature, suggestion, unknown_atom
from testbed.config.models import ExperimentConfig
from testbed.config.places import Finding, Key
from testbed.config.sections import ScenarioSettings, ScriptEntry
from testbed.config.values import NONE
from testbed.environment import EventRules

SCRIPT = "script"
"""Name of the one scenario of a run without scenarios that has a script."""


def scenarios_of(config: ExperimentConfig, known: tuple[str, ...]) -> tuple[str, ...]:
    """The scenarios that are played: those given, or what there is to play in a domain.

    `known` are the domain's. Where an adversary takes the place of triggers the one scenario is
    called as it is. Where there is neither a script nor such an adversary nor a scenario of the
    domain, nothing exogenous happens.
    """
    if config.scenarios:
        return config.scenarios
    if config.script is not None:
        return (SCRIPT,)
    if config.adversary.strategy is not None and not config.plays_triggers:
        return (config.adversary.strategy,)
    return known or (NONE,)


def with_scenarios(config: ExperimentConfig, known: tuple[str, ...]) -> ExperimentConfig:
    """The configuration with all scenarios that it plays, `none` with a script without entries.

    A sweep leaves the script to its conditions, which may have an adversary that needs none.
    """
    scenarios = scenarios_of(config, known)
    found: dict[str, object] = {"scenarios": scenarios}
    if not config.is_sweep and NONE in scenarios and not _is_played(NONE, config, known):
        own = config.scenario_settings.get(NONE, ScenarioSettings())
        nothing = own.model_copy(update={"script": ()})
        found["scenario_settings"] = {**config.scenario_settings, NONE: nothing}
    return config.model_copy(update=found)


def scenario_findings(config: ExperimentConfig, known: tuple[str, ...]) -> Iterator[Finding]:
    """Scenarios that nothing says how to play, and settings of such."""
    for index, name in enumerate(config.scenarios):
        if name != NONE and not _is_played(name, config, known):
            yield ("scenarios", index), f"unknown scenario '{name}'; {_what_is_known(name, known)}"
    for name in config.scenario_settings:
        if name not in config.scenarios and not _is_played(name, config, known):
            key = ("scenario_settings", name)
            yield key, f"unknown scenario; {suggestion(name, (*known, *config.scenarios))}"


def _is_played(name: str, config: ExperimentConfig, known: Collection[str]) -> bool:
    """Whether something says what happens in a scenario: its triggers, a script, or chance."""
    scripted = config.settings(name).script is not None
    return scripted or not config.plays_triggers or name in known


def _what_is_known(name: str, known: Collection[str]) -> str:
    if known:
        return suggestion(name, known)
    return (
        "the domain has no scenarios: with 'scenarios: none' nothing exogenous happens, with "
        "'adversary.strategy: random' events are drawn, and a script may have any name"
    )


MOMENTS = {"step": "step", "at_action": "action of the robot"}
"""The keys that say when an entry happens, and what they count."""


def script_findings(
    key: Key, entries: Sequence[ScriptEntry], signature: Signature
) -> Iterator[Finding]:
    """Entries that are no exogenous actions, and of which it is not clear when they happen.

    Each has one moment, and each moment has one entry.
    """
    for index, entry in enumerate(entries):
        why = unknown_atom(entry.action, signature, ("exogenous",), "exogenous action")
        if why is not None:
            yield (*key, index, "action"), why
        given = {name: getattr(entry, name) for name in MOMENTS if getattr(entry, name) is not None}
        if len(given) != 1:
            yield (*key, index), "give the entry one of step and at_action"
        for name, number in given.items():
            if any(getattr(earlier, name) == number for earlier in entries[:index]):
                what = f"{MOMENTS[name]} {number} has an action already; one a {MOMENTS[name]}"
                yield (*key, index, name), what


def refused_script_findings(
    config: ExperimentConfig, scenarios: Iterable[str]
) -> Iterator[Finding]:
    """Entries that the rules for the adversary never allow: where due, they end a trial in error.

    Looked at are the script of all scenarios, and those of the ones that are played.
    """
    if config.script_policy == "skip":
        return
    rules = EventRules(**config.adversary.bounds())
    own = {name: config.scenario_settings.get(name) for name in scenarios}
    scripts: dict[Key, tuple[ScriptEntry, ...]] = {("script",): config.script or ()}
    scripts |= {
        ("scenario_settings", name, "script"): settings.script or ()
        for name, settings in own.items()
        if settings is not None
    }
    for key, entries in scripts.items():
        for index, entry in enumerate(entries):
            if not rules.permits(entry.action):
                why = f"'{entry.action}' is none of adversary.events"
                yield (*key, index, "action"), f"{why}; list it there, or leave it out"


def early_script_findings(
    config: ExperimentConfig, first_action_steps: Mapping[str, int]
) -> Iterator[Finding]:
    """Entries before a listed robot acts on the world: all of its trials would end in error.

    Nothing exogenous happens while a robot waits. `first_action_steps` are, by the robot's name,
    the first step at which it may act; no later step is certain beforehand.
    """
    if config.script_policy == "skip" or not first_action_steps:
        return
    robot, first = max(first_action_steps.items(), key=lambda item: item[1])
    # Where neither scenarios nor settings are named, all scenarios have the same script.
    named = ("",) if config.script is not None else tuple(config.scenario_settings)
    scripts: dict[Key, tuple[ScriptEntry, ...]] = {}
    for scenario in config.scenarios or named:
        settings, own = config.settings(scenario), config.scenario_settings.get(scenario)
        if not settings.exogenous_while_thinking:
            place = () if own is None or own.script is None else ("scenario_settings", scenario)
            scripts[*place, "script"] = settings.script or ()
    for key, entries in scripts.items():
        for index, entry in enumerate(entries):
            if entry.step is not None and entry.step < first:
                why = f"at step {entry.step} the robot '{robot}' does not act on the world yet"
                right = "give a later step, or exogenous_while_thinking: true"
                yield (*key, index, "step"), f"{why}, when nothing exogenous happens; {right}"
