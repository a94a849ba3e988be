"""Rows of trials are held to the rules of configurations, since their conditions may be edited."""

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import msgspec

from testbed.config import ConfigError, Key, Places, dotted, validated
from testbed.environment import EventRules
from testbed.experiment.checks import CHECKS
from testbed.experiment.record import TrialRecord
from testbed.experiment.specs import BUDGETS, FineSetting, Setting

LEVEL = "made"
"""What the level of a row is called here, whose size is its own."""
OF_THE_ROW: Mapping[Key, Key] = {
    ("robots",): ("robot",),
    ("scenarios",): ("scenario",),
    ("initial",): ("initial",),
    ("limits", "steps"): ("condition", "step_limit"),
    ("limits", "plan"): ("condition", "plan_limit"),
    ("limits",): ("condition",),
    ("adversary", "pace"): ("condition", "fine", "pace"),
    ("adversary",): ("condition",),
    ("level_sizes", LEVEL): ("condition", "fine", "size"),
    ("levels",): ("condition", "fine", "size"),
    ("statistics",): ("condition", "fine", "statistics"),
    ("refinement",): ("condition", "fine", "refinement"),
}
"""Keys of a configuration with those of a row that have the same; others are in its condition."""
LISTS = ("robots", "scenarios", "levels")
"""Keys of a configuration that have a list where a row has one of it."""


class _Places(Places):
    """Says of the key of a configuration where a row has its value.

    The entries of a script are pairs there, those by number of the action in a list of their own.
    """

    def __init__(self, file: Path, setting: Setting) -> None:
        super().__init__(file, "", (), "")
        self._steps = len(setting.script or ())

    def of(self, key: Key) -> str:
        match key:
            case ("script", int(index), *rest):
                late = index - self._steps
                entry: Key = ("script", index) if late < 0 else ("script_at_actions", late)
                key = (*entry, *(int(part == "action") for part in rest))
            case (str(name), *_) if name in LISTS:
                key = (name,)
        return f"{self.file}: {dotted(_of_the_row(key))}"


def _of_the_row(key: Key) -> Key:
    parts = (key[:number] for number in range(len(key), 0, -1))
    known = next((part for part in parts if part in OF_THE_ROW), ())
    return (*OF_THE_ROW.get(known, ("condition",)), *key[len(known) :])


def check_row(file: Path, record: TrialRecord, setting: Setting) -> None:
    """Check what a row is played under: `setting` is its condition, whose files are found.

    Raises ConfigError, with a line for each key that no configuration would allow.
    """
    if not setting.goal:  # which at the fine resolution stands for one that is drawn
        raise ConfigError([f"{file}: condition.goal: should not be empty"])
    keys = _keys(setting) | {"robots": [record.robot], "initial": record.initial}
    if setting.fine is None:
        keys["scenarios"] = [record.scenario]
    validated(keys, file, _Places(file, setting), CHECKS)


def _keys(setting: Setting) -> dict[str, Any]:
    """The configuration that has this setting."""
    own: dict[str, Any] = msgspec.to_builtins(setting, enc_hook=str)
    fine = setting.fine
    same = ("knowledge", "relevance", "plans", "ties", "goal_feedback", "exogenous_while_thinking")
    return {
        "name": "row",
        "goal": own["goal"],
        "observability": own["observability"],
        **{key: own[key] for key in same},
        "script": _script(own),
        "script_policy": "skip" if setting.script_skips else "error",
        "adversary": {
            "strategy": setting.strategy,
            "options": setting.options or {},
            "rate": setting.rate,
            **{field.name: own[field.name] for field in fields(EventRules)},
            "per_object": setting.per_object or {},
        }
        | ({} if fine is None else {"pace": fine.pace}),
        "limits": {
            "steps": setting.step_limit,
            "plan": setting.plan_limit,
            "judge_states": setting.judge_states,
            **{key: own[key] for key in BUDGETS},
        },
        **({"domain": setting.domain} if fine is None else _fine_keys(setting.domain, fine)),
    }


def _fine_keys(domain: str, fine: FineSetting) -> dict[str, Any]:
    common = {"limit": 1, "statistics": fine.statistics}
    if fine.size is None:
        return common | {"domain": domain, "refinement": fine.refinement or ""}
    return common | {
        "levels": [LEVEL],
        "level_sizes": {LEVEL: msgspec.to_builtins(fine.size)},
        "refinement": fine.refinement,
    }


def _script(setting: Mapping[str, Any]) -> list[dict[str, Any]] | None:
    if setting["script"] is None:
        return None
    moments = {"step": "script", "at_action": "script_at_actions"}
    return [
        {moment: number, "action": action}
        for moment, key in moments.items()
        for number, action in setting[key]
    ]
