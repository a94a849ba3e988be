"""Seeds and ids of trials: they follow from the root seed and the trial's seed path."""

import hashlib
from collections.abc import Sequence

import msgspec
import numpy as np


def generator_of(root: int, path: object) -> np.random.Generator:
    """What draws the trial at a seed path."""
    return np.random.default_rng(_sequence(root, ["draw", path]))


def trial_seed(root: int, path: object) -> int:
    """The seed of the trials at a seed path: 32 bits that follow from the root seed and it."""
    return int(_sequence(root, path).generate_state(1)[0])


def _sequence(root: int, path: object) -> np.random.SeedSequence:
    digest = hashlib.blake2b(_canonical(path), digest_size=16).digest()
    words = tuple(int.from_bytes(digest[i : i + 4], "big") for i in range(0, 16, 4))
    return np.random.SeedSequence(root, spawn_key=words)


def drawn_part(count: int, limit: int | None, root: int, scenario: str) -> Sequence[int]:
    """Which of `count` pairs to play: a smaller limit draws a part of what a larger one does."""
    if limit is None or limit >= count:
        return range(count)
    order = np.random.default_rng(_sequence(root, ["limit", scenario])).permutation(count)
    return sorted(int(index) for index in order[:limit])


def playing_order(seed: int, robots: Sequence[str]) -> tuple[str, ...]:
    """The robots of a pair in the order in which they play.

    What one of them has prepared can serve the other, which plays after it in the same process.
    """
    first = seed % len(robots)
    return (*robots[first:], *robots[:first])


def seeds_within(seed: int) -> tuple[int, int, int]:
    """Seeds for a trial's world, adversary and robot, so that none shares another's numbers."""
    world, adversary, robot = np.random.SeedSequence(seed).generate_state(3)
    return int(world), int(adversary), int(robot)


def short_hash(value: object) -> str:
    """An id of whatever can be written as JSON."""
    return hashlib.blake2b(_canonical(value), digest_size=6).hexdigest()


def _canonical(value: object) -> bytes:
    return msgspec.json.encode(value, enc_hook=str, order="deterministic")
