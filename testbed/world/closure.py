"""Sets of literals as bit masks, and their closure under state constraints.

With n fluents, bit i is the literal `f_i` and bit n + i is `-f_i`. A set of literals is a Python
integer, so that a rule fires or not in one comparison.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True)
class LiteralSets:
    """Operations on sets of literals over `size` fluents."""

    size: int

    @property
    def positive(self) -> int:
        """Every positive literal."""
        return (1 << self.size) - 1

    def complete(self, state: int) -> int:
        """The complete set of literals of a state, itself the mask of its true fluents."""
        return state | (self.positive & ~state) << self.size

    def complement(self, literals: int) -> int:
        """Every literal of the set with the other sign."""
        return (literals & self.positive) << self.size | literals >> self.size

    def consistent(self, literals: int) -> bool:
        return not literals & literals >> self.size & self.positive

    def literal(self, number: int, positive: bool) -> int:
        """The mask of one literal."""
        return 1 << number if positive else 1 << self.size + number


Rule: TypeAlias = tuple[int, int]
"""A body, and the one literal that follows where all of it holds."""


class Closure:
    """The consequence operator Cn of a set of rules, and its models under defaults."""

    def __init__(self, sets: LiteralSets, rules: Iterable[Rule]) -> None:
        self._sets = sets
        # By one literal of the body each, if possible a positive one: few fluents are true.
        watched: dict[int, list[Rule]] = {}
        for body, head in rules:
            watched.setdefault(body & -body, []).append((body, head))
        self._watched = tuple(watched.items())

    def consequences(self, literals: int) -> int:
        """Cn: the least superset closed under the rules; it may be inconsistent."""
        before = -1
        while before != literals:
            before = literals
            for watched, rules in self._watched:
                if watched & literals == watched:
                    for body, head in rules:
                        if body & literals == body:
                            literals |= head
        return literals

    def models(self, facts: int, defaults: int) -> tuple[int, ...]:
        """Every consistent S with S = Cn(facts + the defaults whose complement is not in S).

        With facts E(a,s) and defaults that say inertia and the closed world of defined fluents,
        these are the answer sets of the translated program at the next step (D 2.2). Sorted.
        """
        return tuple(sorted(set(self._search(facts, 0, defaults))))

    def _search(self, facts: int, kept: int, undecided: int) -> Iterator[int]:
        all_defaults = kept | undecided
        branches = [(kept, undecided)]
        while branches:
            kept, undecided = self._narrow(facts, *branches.pop())
            model = self.consequences(facts | kept)
            if not self._sets.consistent(model):
                continue
            if undecided:
                chosen = undecided & -undecided
                rest = undecided ^ chosen
                branches += [(kept, rest), (kept | chosen, rest)]
            elif kept == all_defaults & ~self._sets.complement(model):
                yield model

    def _narrow(self, facts: int, kept: int, undecided: int) -> tuple[int, int]:
        """Decide what every model below must agree on, as in the well-founded semantics.

        A default is dropped when its complement follows from what is certain, kept when its
        complement does not follow even from all that is possible.
        """
        complement = self._sets.complement
        before = -1
        while undecided and before != undecided:
            before = undecided
            undecided &= ~complement(self.consequences(facts | kept))
            possible = self.consequences(facts | kept | undecided)
            safe = undecided & ~complement(possible)
            kept, undecided = kept | safe, undecided ^ safe
        return kept, undecided


def bits(mask: int) -> Iterator[int]:
    """The numbers of the set bits, ascending."""
    while mask:
        low = mask & -mask
        yield low.bit_length() - 1
        mask ^= low
