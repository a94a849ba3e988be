"""Theories with a rule left out: some case of the tests has to fail for each of them."""

from __future__ import annotations

import random
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from benchmarks.sheets import Row, Sheet

CASES = Path(__file__).parent.parent / "tests" / "asp"
SAMPLE = 12
SEED = 1

LETTERED = ("defaults", "diagnosis", "fine_planning")
"""Theories with paragraphs that have a letter instead of a number."""

Mutant = tuple[int | str, int | None]
"""An axiom's number, or a theory and a letter, and which rule is left out, from 1; None: all."""


def main(size: str) -> list[Sheet]:
    """Sheets `mutation`, with a row for each mutant, and `survivors`, which should be empty."""
    mutants = list(all_mutants())
    if size == "small":
        mutants = sorted(random.Random(SEED).sample(mutants, SAMPLE), key=str)
    rows = [_row(mutant) for mutant in mutants]
    survivors = [row for row in rows if not row["killed"]]
    killed = len(rows) - len(survivors)
    counts: Row = {"mutants": len(rows), "killed": killed, "survived": len(survivors)}
    return [
        Sheet("mutation", "Each rule and each axiom left out", rows),
        Sheet("survivors", "Left out and not missed", survivors),
        Sheet("killed", "Mutants", [counts]),
    ]


def all_mutants() -> Iterator[Mutant]:
    """Each axiom left out as a whole, and where it has several rules, each of them."""
    texts = _module("axioms")
    blocks = dict(sorted(texts.axioms().items()))
    for theory in LETTERED:
        blocks |= texts.lettered(theory)
    for number, block in blocks.items():
        yield number, None
        if len(block.rules) > 1:
            yield from ((number, rule) for rule in range(1, len(block.rules) + 1))


def _row(mutant: Mutant) -> Row:
    number, rule = mutant
    without = _module("axioms").Without(number, rule)
    failing = next(
        (case for case in _cases(number) if not case.claim.holds(case.program.solver(without))),
        None,
    )
    return {
        "axiom": number,
        "rule": "all" if rule is None else str(rule),
        "killed": failing is not None,
        "by": "" if failing is None else f"({failing.number}) {failing.sentence}",
    }


def _cases(number: int | str) -> list[Any]:
    """Every case, those of the axiom first."""
    modules = [_module(path.stem) for path in sorted(CASES.glob("cases_of_*.py"))]
    cases = [case for module in modules for case in module.CASES]
    return sorted(cases, key=lambda case: bool(case.number != number))


def _module(name: str) -> Any:
    """A module of the tests, which find each other by their bare names."""
    if str(CASES) not in sys.path:
        sys.path.append(str(CASES))
    return import_module(name)
