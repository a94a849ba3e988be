"""Answers in words: a sentence made from the numbers of an answer, and of nothing else."""

from collections.abc import Mapping
from math import floor
from typing import Any

from testbed.text import chance

SUCCESS, COST = "success", "cost"
"""The questions: who achieves its goal more often, and who needs less where both do."""
OVERALL = "all conditions"
"""What stands for the conditions of a sweep together."""
SUBJECTS = {SUCCESS: "success", COST: "the cost where both achieve"}


def sentence(answer: Mapping[str, Any]) -> str:
    """An answer as a sentence; of a sweep with the first and the last condition that differ."""
    differ = answer["differ"]
    if not differ[0]["condition"]:
        over = f"over {answer['under']} " if answer["under"] else ""
        said = f"{over}{_said(answer, differ[0])}."
        return said if said.startswith(answer["treatment"]) else _capital(said)
    places = ("first at", "last at") if len(differ) > 1 else ("at",)
    ends = zip(places, (differ[0], differ[-1]), strict=False)
    told = ", ".join(f"{place} {_named(answer, own)} ({_said(answer, own)})" for place, own in ends)
    under = f"with {answer['under']} " if answer["under"] else ""
    subject = SUBJECTS[answer["question"]]
    number = f"{len(differ)} of {answer['conditions']} conditions"
    return f"{_capital(under + subject)} differs in {number}, {told}."


def _said(answer: Mapping[str, Any], own: Mapping[str, Any]) -> str:
    """What is found under one condition."""
    baseline, treatment = answer["baseline"], answer["treatment"]
    if answer["question"] == SUCCESS:
        more, less = (_percent(own[f"{who}_achieved"]) for who in ("treatment", "baseline"))
        return f"{treatment} achieved {more} of {own['pairs']}, {baseline} {less}, {_chance(own)}"
    ratio = own["ratio"]
    return (
        f"where both achieve, in {own['pairs']} pairs, {baseline} needs "
        f"{ratio['value']:.2f} times the execution units of {treatment}, {_chance(own, ratio)}"
    )


def _chance(own: Mapping[str, Any], estimate: Mapping[str, Any] | None = None) -> str:
    """How sure that is: the interval of an estimate, and p after correction."""
    if own["exhaustive"]:
        return "without an interval, since all initial states were played and nothing was drawn"
    if estimate is None or estimate["low"] is None:
        return chance(own["holm"])
    return f"95% interval {estimate['low']:.2f} to {estimate['high']:.2f}"


def _percent(share: Mapping[str, Any]) -> str:
    """A share in percent with at most one decimal; only all of them are 100%."""
    tenths = round(1000 * share["value"])
    if tenths == 1000 and share["value"] < 1:
        tenths = floor(1000 * share["value"])
    return f"{tenths / 10:g}%"


def _named(answer: Mapping[str, Any], own: Mapping[str, Any]) -> str:
    """A condition without what all conditions of the curve have in common."""
    name: str = own["condition"]
    return name.removeprefix(f"{answer['under']}, ")


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
