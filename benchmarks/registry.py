"""The benchmarks by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from benchmarks import decisions, growth, memory, mutation, peers
from benchmarks.sheets import Sheet

SIZES = ("small", "full")

BENCHMARKS: Mapping[str, Callable[[str], list[Sheet]]] = {
    "decisions": decisions.main,
    "growth": growth.main,
    "peers": peers.main,
    "memory": memory.main,
    "mutation": mutation.main,
}
