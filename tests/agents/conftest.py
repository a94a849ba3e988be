"""What tests of several robots share."""

import gc
from collections.abc import Iterator

import pytest


@pytest.fixture
def uncollected() -> Iterator[None]:
    """Without the garbage collector: what is freed has no reference left."""
    gc.collect()
    gc.disable()
    yield
    gc.enable()
