"""What the agent decides at a step."""

from __future__ import annotations

from dataclasses import dataclass

from agents.shared.diagnosis import Explained


@dataclass(frozen=True)
class Intention:
    """What the agent intends at a step, the plan it would start with it, and what it believes.

    `under` is the explanation that it believes in, where this is chosen with the intention.
    """

    action: str
    plan: tuple[str, ...]
    believed: frozenset[str]
    under: Explained | None = None
