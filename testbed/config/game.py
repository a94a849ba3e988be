"""Check the rules of the game between robot and adversary: what a domain allows of them."""

from collections.abc import Iterator

from asp.language import Literal, Signature, suggestion, unknown_atom
from testbed.config.places import Finding
from testbed.config.sections import AdversarySettings, RewardSettings

IN_UNITS = ("waste", "regret")
"""Rewards of an adversary in execution units."""


def event_findings(own: AdversarySettings, signature: Signature) -> Iterator[Finding]:
    """Sorts and events of the rules for the adversary that a domain does not have."""
    for sort in own.per_object:
        if sort not in signature.sorts:
            near = suggestion(sort, signature.sorts)
            yield ("adversary", "per_object", sort), f"no such sort; {near}"
    for index, event in enumerate(own.events or ()):
        key = ("adversary", "events", index)
        if (why := _unknown(event, signature)) is not None:
            yield key, why
        elif event in (own.events or ())[:index]:
            yield key, f"'{event}' is listed twice; keep one of the two"


def _unknown(event: Literal, signature: Signature) -> str | None:
    """Why an event is neither a ground exogenous action nor the name of some."""
    symbol = signature.symbols.get(event)
    if symbol is not None and symbol.kind == "exogenous":
        return None
    return unknown_atom(event, signature, ("exogenous",), "exogenous action")


def reward_findings(own: RewardSettings) -> Iterator[Finding]:
    """Rewards that the fine resolution does not have."""
    why = "is in execution units, which actions of the fine resolution do not have"
    if own.adversary in IN_UNITS:
        yield ("rewards", "adversary"), f"{own.adversary} {why}; give zero_sum or fail"
    if own.shaping:
        yield ("rewards", "shaping"), f"{why}; leave it out"
