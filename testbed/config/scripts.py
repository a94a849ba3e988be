"""Check the scripts of a configuration: what they name, when, and what can happen at step 1."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from asp import Description
from testbed.config.models import ExperimentConfig, ScriptEntry
from testbed.config.places import Key
from testbed.config.words import Finding, unknown_atom

MOMENTS = {"step": "step", "at_action": "action of the robot"}
"""The keys that say when an entry happens, and what they count."""


def script_findings(
    key: Key, entries: Sequence[ScriptEntry], description: Description
) -> Iterator[Finding]:
    """Entries that the domain does not know, or of which it is not clear when they happen."""
    known = description.exogenous_actions
    for index, entry in enumerate(entries):
        if entry.action not in known:
            yield (*key, index, "action"), unknown_atom(entry.action, known, "exogenous action")
    yield from moment_findings(key, entries)


def moment_findings(key: Key, entries: Sequence[ScriptEntry]) -> Iterator[Finding]:
    """Entries without a moment or with two, and moments that have two entries."""
    for index, entry in enumerate(entries):
        given = {name: getattr(entry, name) for name in MOMENTS if getattr(entry, name) is not None}
        if len(given) != 1:
            yield (*key, index), "give the entry one of step and at_action"
        for name, number in given.items():
            if any(getattr(earlier, name) == number for earlier in entries[:index]):
                what = f"{MOMENTS[name]} {number} has an action already; one a {MOMENTS[name]}"
                yield (*key, index, name), what


def first_step_findings(config: ExperimentConfig, starters: Collection[str]) -> Iterator[Finding]:
    """Entries at step 1, at which a listed robot only starts its activity, or finishes.

    Nothing exogenous happens then, so that the robot's trials would all end in error. `starters`
    are the robots that act on the world from step 2 on. No other step is certain beforehand.
    """
    robot = next((name for name in config.robots if name in starters), None)
    if config.script_policy == "skip":
        return
    for key, entries in dict(_closed_scripts(config)).items() if robot else ():
        for index, entry in enumerate(entries):
            if entry.step == 1:
                yield (
                    (*key, index, "step"),
                    f"at step 1 the robot '{robot}' starts its activity and waits, when nothing "
                    "exogenous happens; give a later step, or exogenous_while_thinking: true",
                )


def _closed_scripts(config: ExperimentConfig) -> Iterator[tuple[Key, tuple[ScriptEntry, ...]]]:
    """By their keys the scripts that are played where nothing happens while the robot waits."""
    for scenario in _played(config):
        settings = config.settings(scenario)
        if settings.script and not settings.exogenous_while_thinking:
            own = config.scenario_settings.get(scenario)
            shared = own is None or own.script is None
            yield (() if shared else ("scenario_settings", scenario)) + ("script",), settings.script


def _played(config: ExperimentConfig) -> tuple[str, ...]:
    """The scenarios that a script may be played in; without a name, where all have the same."""
    if config.scenarios:
        return config.scenarios
    return ("",) if config.script is not None else tuple(config.scenario_settings)
