"""Theories with a rule left out: some test has to fail for each of them.

Of what has a number or a letter, cases about small programs are asked, in this process; of every
other rule of every theory, the tests that exercise the theory.
"""

import random
import sys
from collections.abc import Iterable, Iterator
from importlib import import_module
from itertools import chain
from pathlib import Path
from typing import Any

from benchmarks.mutants import check_killers, killers
from benchmarks.sheets import Row, Sheet, gathered
from benchmarks.statements import Statement, statements, theories

CASES = Path(__file__).parent.parent / "tests" / "asp" / "theories"
SAMPLE = 12
QUICK = ("reach", "conflict")
"""Theories whose tests find within seconds what is left out: one rule of each is in the sample."""
SEED = 1

LETTERED = ("defaults", "diagnosis", "fine_planning")
"""Theories with paragraphs that have a letter instead of a number, each with cases of its own."""

Mutant = tuple[int | str, int | None]
"""An axiom's number, or a theory and a letter, and which rule is left out, from 1; None: all."""


def main(size: str) -> list[Sheet]:
    """Sheets `mutation`, with a row for each mutant, and `survivors`, which should be empty.

    In `redundant` are the rules that the theories mark so: none of them should be killed.
    """
    draw = random.Random(SEED)
    axioms, rules = list(all_mutants()), list(unlabelled())
    if size == "small":
        axioms = sorted(draw.sample(axioms, SAMPLE), key=str)
        rules = [draw.choice([rule for rule in rules if rule.theory == name]) for name in QUICK]
    rows = gathered(chain(map(_row, axioms), _rows(rules)))
    marked = {rule.key for rule in rules if rule.redundant}
    needed = [row for row in rows if row["left_out"] not in marked]
    redundant = [row for row in rows if row["left_out"] in marked]
    survivors = [row for row in needed if not row["killed"]]
    return [
        Sheet("mutation", "Each rule and each axiom left out", needed),
        Sheet("redundant", "Left out what only saves time", redundant),
        Sheet("survivors", "Left out and not missed", survivors),
        Sheet("killed", "Mutants", [_counts(needed, redundant)]),
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


def unlabelled() -> Iterator[Statement]:
    """The rules of all theories that are in none of these axioms."""
    for theory in theories():
        stated = _lines_of_axioms(theory)
        yield from (rule for rule in statements(theory) if rule.line not in stated)


def _lines_of_axioms(theory: str) -> set[int]:
    texts = _module("axioms")
    if theory not in (*texts.THEORIES, *LETTERED):
        return set()
    found: set[int] = set()
    line = 1
    for block in texts.blocks(theory):
        size = len(block.text.split("\n"))
        if isinstance(block.number, int) or (block.number and theory in LETTERED):
            found.update(range(line, line + size))
        line += size + 1
    return found


def _row(mutant: Mutant) -> Row:
    number, rule = mutant
    without = _module("axioms").Without(number, rule)
    failing = next(
        (case for case in _cases(number) if not case.claim.holds(case.program.solver(without))),
        None,
    )
    return {
        "left_out": f"({number})",
        "rule": "all" if rule is None else str(rule),
        "killed": failing is not None,
        "by": "" if failing is None else f"({failing.number}) {failing.sentence}",
    }


def _rows(rules: Iterable[Statement]) -> Iterator[Row]:
    """Raises DisagreementError where a test fails that nothing was left out for."""
    failed = []
    for rule, test in killers(rules):
        failed.append(test)
        yield {"left_out": rule.key, "rule": rule.text, "killed": test != "", "by": test}
    check_killers(failed)


def _counts(needed: list[Row], redundant: list[Row]) -> Row:
    killed = sum(bool(row["killed"]) for row in needed)
    return {
        "mutants": len(needed),
        "killed": killed,
        "survived": len(needed) - killed,
        "redundant": len(redundant),
        "redundant_killed": sum(bool(row["killed"]) for row in redundant),
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
