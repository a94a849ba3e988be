"""What tests of benchmarks share."""

import gc
from collections.abc import Iterator

import pytest


@pytest.fixture
def own_heap() -> Iterator[None]:
    """The garbage collector leaves out what earlier tests left, millions of objects in a suite.

    Benchmarks collect before whatever they measure, and in each process that they fork.
    """
    gc.freeze()
    yield
    gc.unfreeze()
