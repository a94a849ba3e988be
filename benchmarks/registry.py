"""The benchmarks by name."""

from collections.abc import Callable, Mapping
from pathlib import Path

from benchmarks import (
    ablation,
    adversaries,
    adversary_steps,
    batches,
    branches,
    chaos,
    decisions,
    driver,
    environments,
    equality,
    fairness,
    figures,
    games,
    growth,
    hostile,
    joint_growth,
    large_runs,
    memory,
    mutation,
    peers,
    refinements,
    robustness,
    rooms,
    worlds,
    zooming,
)
from benchmarks.sheets import Sheet

SIZES = ("small", "full")

BENCHMARKS: Mapping[str, Callable[[str], list[Sheet]]] = {
    "decisions": decisions.main,
    "growth": growth.main,
    "hostile": hostile.main,
    "peers": peers.main,
    "memory": memory.main,
    "driver": driver.main,
    "large_runs": large_runs.main,
    "chaos": chaos.main,
    "mutation": mutation.main,
    "games": games.main,
    "joint_growth": joint_growth.main,
    "zooming": zooming.main,
    "refinements": refinements.main,
    "equality": equality.main,
    "rooms": rooms.main,
    "worlds": worlds.main,
    "ablation": ablation.main,
    "batches": batches.main,
    "adversaries": adversaries.main,
    "adversary_steps": adversary_steps.main,
    "branches": branches.main,
    "environments": environments.main,
    "fairness": fairness.main,
    "robustness": robustness.main,
}

FIGURES: Mapping[str, Callable[[list[Sheet], Path], None]] = {
    "growth": figures.draw,
    "hostile": figures.draw,
}
"""The benchmarks that draw what they found beside their JSON."""
