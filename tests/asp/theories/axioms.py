"""Theories cut into their numbered axioms, and claims about the answer sets of small programs."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache

import clingo
from clingo import Symbol

from asp.language import read_domain
from asp.solving import theory
from asp.translation import translate

_NUMBER = re.compile(r"% \((\d+|[a-z])\) \S")
_END_OF_RULE = re.compile(r"\.[ \t]*\n")

THEORIES = ("history", "intentions", "diagnosis", "planning")


@dataclass(frozen=True)
class Block:
    """A paragraph of a theory: its text, its rules, and its number if it is an axiom.

    Paragraphs with a letter are numbered by theory and letter: `defaults.a`.
    """

    number: int | str | None
    text: str
    rules: tuple[str, ...]


@cache
def blocks(name: str) -> tuple[Block, ...]:
    """The paragraphs of `asp/theories/NAME.lp`, in order."""
    return tuple(_block(name, text) for text in theory(name).split("\n\n"))


def _block(theory_name: str, text: str) -> Block:
    match = _NUMBER.match(text)
    lines = [line for line in text.splitlines() if not line.startswith("%")]
    rules = _END_OF_RULE.split("\n".join(lines) + "\n")
    return Block(
        None if match is None else _number(theory_name, match.group(1)),
        text,
        tuple(rule.strip() + "." for rule in rules if rule.strip()),
    )


def _number(theory_name: str, label: str) -> int | str:
    return int(label) if label.isdigit() else f"{theory_name}.{label}"


def lettered(name: str) -> dict[str, Block]:
    """The paragraphs of a theory that have a letter."""
    return {block.number: block for block in blocks(name) if isinstance(block.number, str)}


@cache
def axioms() -> dict[int, Block]:
    """Every numbered block of every theory. Raises ValueError if a number stands twice."""
    found: dict[int, Block] = {}
    for name in THEORIES:
        for block in blocks(name):
            if isinstance(block.number, int):
                if block.number in found:
                    raise ValueError(f"axiom ({block.number}) stands twice")
                found[block.number] = block
    return found


@dataclass(frozen=True)
class Without:
    """What is left out of the theories.

    An axiom, or one rule of it (`rule`, counted from 1), or one condition of this rule's body.
    """

    number: int | str
    rule: int | None = None
    condition: str | None = None


def theory_text(name: str, without: Without | None = None) -> str:
    """A theory's text, with or without one of its axioms or rules."""
    return "\n\n".join(_kept(block, without) for block in blocks(name))


def _kept(block: Block, without: Without | None) -> str:
    if without is None or block.number != without.number:
        return block.text
    rules = list(block.rules)
    if without.rule is None:
        return ""
    if without.condition is None:
        del rules[without.rule - 1]
    else:
        rules[without.rule - 1] = _weaker(rules[without.rule - 1], without.condition)
    return "\n".join(rules)


def _weaker(rule: str, condition: str) -> str:
    """The rule without a condition of its body. Raises ValueError if it has no such condition."""
    text = " ".join(rule.split())
    for part in (f", {condition}", f"; {condition}", f"{condition}, "):
        if text.count(part) == 1:
            return text.replace(part, "")
    raise ValueError(f"no one condition {condition} in: {text}")


@cache
def domain_text(name_or_path: str) -> str:
    """The translation of a packaged domain or of an .al file."""
    file, text = read_domain(name_or_path)
    return translate(text, file)


@dataclass(frozen=True)
class Program:
    """A domain's translation with theories, constants and facts or rules of its own."""

    domain: str
    theories: tuple[str, ...]
    rules: str
    constants: dict[str, int] = field(default_factory=dict)

    def solver(self, without: Without | None = None) -> Solver:
        """The ground program."""
        texts = [self.domain, *(theory_text(name, without) for name in self.theories), self.rules]
        return Solver(texts, self.constants)


class Solver:
    """Asks whether a ground program has an answer set with, or without, some literals."""

    def __init__(self, texts: Iterable[str], constants: dict[str, int]) -> None:
        given = [part for name, value in constants.items() for part in ("-c", f"{name}={value}")]
        self.control = clingo.Control([*given, "--warn=none"])
        for text in texts:
            self.control.add("base", [], text)
        self.control.ground([("base", [])])

    def some(self, true: Sequence[str] = (), false: Sequence[str] = ()) -> bool:
        """Whether an answer set holds all of `true` and none of `false`."""
        wanted = [(_symbol(text), True) for text in true]
        if any(self.control.symbolic_atoms[atom] is None for atom, _ in wanted):
            return False
        unwanted = [(_symbol(text), False) for text in false]
        return bool(self.control.solve(assumptions=[*wanted, *unwanted]).satisfiable)


def _symbol(text: str) -> Symbol:
    return clingo.parse_term(text)


class Claim(ABC):
    """A statement about the answer sets of a program."""

    @abstractmethod
    def holds(self, solver: Solver) -> bool:
        """Whether it is true of the program."""


@dataclass(frozen=True)
class Always(Claim):
    """There is an answer set, and every one holds the literal."""

    literal: str

    def holds(self, solver: Solver) -> bool:
        return solver.some() and not solver.some(false=[self.literal])


@dataclass(frozen=True)
class Never(Claim):
    """There is an answer set, and none holds all of the literals together."""

    literals: tuple[str, ...]

    def holds(self, solver: Solver) -> bool:
        return solver.some() and not solver.some(true=self.literals)


@dataclass(frozen=True)
class Possible(Claim):
    """Some answer set holds all of the literals; without literals: there is an answer set."""

    literals: tuple[str, ...] = ()

    def holds(self, solver: Solver) -> bool:
        return solver.some(true=self.literals)


@dataclass(frozen=True)
class Inconsistent(Claim):
    """There is no answer set."""

    def holds(self, solver: Solver) -> bool:
        return not solver.some()


def never(*literals: str) -> Never:
    return Never(literals)


def possible(*literals: str) -> Possible:
    return Possible(literals)
