"""A random description, and how the sides of a comparison are told apart."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from random import Random

from asp import Domain
from asp.reasoning import Knowledge
from asp.translation import translate
from benchmarks.descriptions.definition import Definition, State
from benchmarks.descriptions.drawing import random_description
from benchmarks.descriptions.language import mistakes
from benchmarks.descriptions.text import Description
from benchmarks.sheets import DisagreementError

FILE = "own.al"


@dataclass(frozen=True)
class Case:
    """A description, a source of chance for what is asked of it, and a folder for files."""

    description: Description
    random: Random
    folder: Path

    @staticmethod
    def of(seed: int, folder: Path) -> Case:
        """The case of a seed; its description need not be of the language."""
        random = Random(seed)
        return Case(random_description(random), random, folder)

    @cached_property
    def is_of_the_language(self) -> bool:
        """Whether it is read; what is not is refused, each mistake in one line with its place."""
        return not mistakes(self.description.text, self.folder / FILE)

    @cached_property
    def definition(self) -> Definition:
        """What it means, for a description of the language."""
        return Definition(self.description)

    @cached_property
    def domain(self) -> Domain:
        """The same to be reasoned about. Raises SourceError."""
        return Domain(self.description.text, FILE)

    @cached_property
    def knowledge(self) -> Knowledge:
        """The same as reasoners have it. Raises SourceError."""
        return Knowledge.of(self.domain.description, translate(self.description.text, FILE))

    def some_states(self, most: int) -> list[State]:
        """At most so many states."""
        states = self.definition.states
        return self.random.sample(states, min(most, len(states)))


def agree(what: str, **sides: object) -> None:
    """Raises DisagreementError where the sides are not all equal."""
    first, *others = sides.values()
    if any(other != first for other in others):
        told = "\n".join(f"  {name}: {side}" for name, side in sides.items())
        raise DisagreementError(f"{what}\n{told}")
