"""A small configuration of the office, and a domain that shares no word with it."""

from collections.abc import Callable
from pathlib import Path

import pytest

from testbed.config import ConfigError, load_config

VALID = """\
name: tiny
seed: 3
goal: ["loc(book1,library)"]
initial: ["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)"]
scenarios: [1, random]
scenario_settings:
  1: {goal: ["loc(book2,office1)"], script: []}
observability:
  exo_move: {mode: colocated, probability: 0.5}
limits:
  steps: 20
"""

LAMP = """\
sorts
  robot = {walle}.
fluents
  inertial lit.
actions
  agent     press(robot).
  exogenous cut.
laws
  press(R) causes lit.
  cut      causes -lit.
sees
  R sees lit if robot(R).
scenarios
  1: cut upon press(R) probability 0.
"""


def file_of(folder: Path, text: str) -> Path:
    """The configuration file with this text."""
    path = folder / "tiny.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def refusal(
    folder: Path, text: str, *overrides: str, read: Callable[..., object] = load_config
) -> list[str]:
    """The lines in which a configuration is refused, of its path only the name."""
    with pytest.raises(ConfigError) as caught:
        read(file_of(folder, text), overrides)
    prefix = f"{folder / 'tiny.yaml'}"
    return [line.replace(prefix, "tiny.yaml") for line in str(caught.value).splitlines()]
