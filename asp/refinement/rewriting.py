"""What refining one law needs to know of both texts."""

from __future__ import annotations

from dataclasses import dataclass

from asp.language import Problems, syntax
from asp.refinement.vocabulary import Vocabulary


@dataclass(frozen=True)
class Rewriting:
    """The names, the coarse text, and the places of fluents that components share.

    `problems` are those of the coarse text: laws that cannot be refined are reported there.
    """

    vocabulary: Vocabulary
    coarse: syntax.Source
    shared: frozenset[tuple[str, int]]
    problems: Problems

    def has_counterpart(self, atom: syntax.Atom) -> bool:
        return atom.name in self.vocabulary.counterparts
