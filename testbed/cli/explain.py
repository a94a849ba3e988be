"""Explain a history in a domain."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from testbed.cli.common import FAILED, Domain, examples, input_errors, say
from testbed.text import warn

if TYPE_CHECKING:
    from asp.reasoning.diagnosis import Explanation

MOST = 1000
EPILOG = examples("testbed explain office history.yaml --all")


def command(
    source: Domain,
    history: Annotated[Path, typer.Argument(metavar="HISTORY.yaml", help="Its form is above.")],
    every: Annotated[bool, typer.Option("--all", help=f"All as small, {MOST} at most.")] = False,
) -> None:
    """Find the smallest explanation of what was observed, attempted and reported, step by step.

    It has the fewest exogenous actions that nobody reported and reports that are false, and then
    the fewest exceptions to defaults. The exit code is 1 where nothing explains the history.

    \b
    A history, in which every key of a step may be left out:
      goal: ["loc(book1,library)"]         # only where a step tells of it
      history:
      - observed: ["loc(rob1,office1)", "loc(book1,library)"]
        attempted: move(rob1,office2)
        took_effect: true                  # if left out
        reported: ["exo_lock(library)"]    # exogenous actions
      - observed: ["loc(rob1,office2)"]
        goal: false                        # it was seen not to hold
    """
    from asp import DomainError, load
    from asp.reasoning.diagnosis import InconsistentHistoryError
    from testbed.config import ConfigError
    from testbed.config.histories import read_history

    with input_errors():
        domain = load(source)
        told, places = read_history(history, domain.description)
        try:
            first = [domain.explain(told.steps, told.goal)]
            others, more = (
                domain.explanations(told.steps, told.goal, MOST) if every else ([], False)
            )
        except DomainError as error:
            raise ConfigError(places.lines([(error.key, error.message)])) from None
        except InconsistentHistoryError as error:
            say(str(error))
            raise typer.Exit(FAILED) from None
        for number, explanation in enumerate(others or first):
            for line in [*["or"][:number], *_told(explanation)]:
                say(line)
        if more:
            warn(f"there are more explanations that are as small: these are the first {MOST}")


def _told(explanation: "Explanation") -> Iterator[str]:
    """One line per assumption."""
    yield from (f"step {step}: {event} happened" for step, event in explanation.unobserved)
    yield from (f"step {step}: {event} did not happen" for step, event in explanation.distrusted)
    yield from (f"step 0: exception to {default}" for default in explanation.exceptions)
    yield from (f"step 0: {literal}" for literal in explanation.initial)
    if explanation.price == (0, 0):
        yield "nothing unexpected"
