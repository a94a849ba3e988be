"""Fixtures of the tests of environments."""

import warnings
from collections.abc import Iterator

import pytest


@pytest.fixture
def strict() -> Iterator[None]:
    """What PettingZoo warns of is an error, but for what is meant."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # 1.27 takes a Dict observation for a mistake, though it then looks at its parts.
        warnings.filterwarnings("ignore", "Observation is not a NumPy array")
        warnings.filterwarnings("ignore", "Observation space for each agent probably should be")
        # The agents have different actions, hence masks, and the adversary sees the robot's.
        warnings.filterwarnings("ignore", "Agents have different observation space sizes")
        warnings.filterwarnings("ignore", "Observations are different shapes")
        yield
