"""The adversary of a trial: an explicit script, random events, or the scenario's triggers."""

from __future__ import annotations

import dataclasses

from agents.adversary.base import Adversary, AdversaryView
from agents.adversary.random import Random
from agents.adversary.scripted import Script, Triggered
from asp import Description
from testbed.config import RANDOM_RATE
from testbed.experiment.specs import Setting, TrialSpec

__all__ = ["Adversary", "AdversaryView", "make_adversary"]


def make_adversary(spec: TrialSpec, description: Description) -> Adversary:
    """The adversary that plays a trial. Raises ValueError for an unknown scenario."""
    if spec.setting.script is not None:
        return script_of(spec.setting)
    if spec.setting.random_events:
        rate = RANDOM_RATE if spec.setting.rate is None else spec.setting.rate
        return Random(description.exogenous_actions, rate)
    return Triggered(_at_rate(description, spec.setting.rate), spec.scenario)


def script_of(setting: Setting) -> Script:
    """The script of a setting, which has one."""
    return Script(setting.script or (), setting.script_at_actions, setting.script_skips)


def _at_rate(description: Description, rate: float | None) -> Description:
    if rate is None:
        return description
    triggers = tuple(dataclasses.replace(t, probability=rate) for t in description.triggers)
    return dataclasses.replace(description, triggers=triggers)
