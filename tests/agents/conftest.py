"""What tests of several robots share."""

import gc
from collections.abc import Iterator

import pytest

# What differs is shown where the two ways of reasoning do.
pytest.register_assert_rewrite("tests.agents.both_ways")


@pytest.fixture
def uncollected() -> Iterator[None]:
    """Without the garbage collector: what is freed has no reference left."""
    gc.collect()
    gc.disable()
    yield
    gc.enable()
