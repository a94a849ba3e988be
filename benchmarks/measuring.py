"""Clocks: medians and quantiles, caches that are emptied, calls that may take no longer."""

from __future__ import annotations

import gc
import math
import multiprocessing
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import _lru_cache_wrapper
from multiprocessing.connection import Connection
from typing import TypeVar

from asp.solving import Answers

T = TypeVar("T")

_ANSWERS = ("asp.reasoning", "asp.solving", "agents.")
_NO_ANSWER = ("asp.reasoning.knowledge", "asp.solving.solver")


def timed(call: Callable[[], T]) -> tuple[float, T]:
    """Milliseconds of a call, and its result."""
    began = time.perf_counter()
    result = call()
    return (time.perf_counter() - began) * 1e3, result


def quantile(values: Sequence[float], share: float) -> float:
    """The value below which this share of the values lies (nearest rank)."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def median(values: Sequence[float]) -> float:
    return quantile(values, 0.5)


@contextmanager
def no_collection() -> Iterator[None]:
    """Without the garbage collector, which would add its pauses to whatever is measured."""
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def forget() -> None:
    """Empties what robots remember of answers; what is grounded stays grounded.

    An answer from memory is no reasoning: without this a trial that is played twice costs nothing
    the second time.
    """
    for found in gc.get_objects():
        kind = type(found)  # of a hundred thousand objects, which isinstance takes longer to tell
        if kind is _lru_cache_wrapper and _is_of_answers(found):
            found.cache_clear()
        elif kind is Answers:
            found.forget()


def _is_of_answers(memory: _lru_cache_wrapper[object]) -> bool:
    module = memory.__wrapped__.__module__
    return module.startswith(_ANSWERS) and not module.startswith(_NO_ANSWER)


def within(seconds: float, call: Callable[[], T]) -> T | None:
    """The result of a call in a process of its own; None if it takes longer and was ended.

    With `math.inf` it takes as long as it takes. Grounding cannot be interrupted from within.
    Raises RuntimeError if the process broke down.
    """
    receiver, sender = multiprocessing.get_context("fork").Pipe(duplex=False)
    process = multiprocessing.get_context("fork").Process(target=_send, args=(sender, call))
    process.start()
    sender.close()
    try:
        if not receiver.poll(None if seconds == math.inf else seconds):
            return None
        result: T = receiver.recv()
        return result
    except EOFError:
        raise RuntimeError("the measured process broke down") from None
    finally:
        process.kill()
        process.join()
        receiver.close()


def _send(sender: Connection, call: Callable[[], object]) -> None:
    sender.send(call())
