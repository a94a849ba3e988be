"""What the agent decides at a step."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Intention:
    """What the agent intends at a step, the plan it would start with it, and what it believes."""

    action: str
    plan: tuple[str, ...]
    believed: frozenset[str]
