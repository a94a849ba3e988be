"""A coarse description together with its refinements."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product

from asp.language import Description, Literal, Signature, parse_description, syntax
from asp.refinement.language import Vocabulary


@dataclass(frozen=True, eq=False)
class Refinement:
    """D_c and D_f: `weak` is the physics of D_f, `strong` has the theory of observation, too.

    `statics` are those that are true, the same in both. `text` is what refines D_c, as it was read.

    The refined descriptions are texts and their syntax: their instances are many more than a
    program needs, so that nothing here makes them.
    """

    coarse: syntax.Source
    coarse_signature: Signature
    vocabulary: Vocabulary
    weak: syntax.Source
    weak_signature: Signature
    strong: syntax.Source
    strong_signature: Signature
    statics: frozenset[Literal]
    text: str

    @cached_property
    def description(self) -> Description:
        """The ground coarse description."""
        return parse_description(self.coarse.text, self.coarse.file)

    @property
    def components(self) -> Mapping[str, tuple[str, ...]]:
        """The components of each coarse constant; one that is not magnified is its own."""
        return self.vocabulary.components

    @cached_property
    def wholes(self) -> Mapping[str, str]:
        """The coarse constant to which each fine constant belongs."""
        return {part: whole for whole, parts in self.components.items() for part in parts}

    @cached_property
    def constants(self) -> frozenset[str]:
        """The constants of either resolution."""
        return self.coarse_signature.constants.union(self.wholes)

    @property
    def counterparts(self) -> Mapping[str, str]:
        """The names of the counterparts: `loc` to `fine_loc`, `move` to `fine_move`."""
        return self.vocabulary.counterparts

    @cached_property
    def _coarse_names(self) -> Mapping[str, str]:
        return {fine: coarse for coarse, fine in self.counterparts.items()}

    def coarse_of(self, literal: Literal) -> tuple[Literal, ...]:
        """What a fine literal or action says at the coarse resolution by itself.

        `fine_loc(object1_1,room1_2)` says `loc(object1,room1)`; a negative one says something
        only of constants with one component. What has no counterpart says itself.
        """
        fine = Literal.parse(literal)
        coarse = self._coarse_names.get(fine.name)
        if coarse is None:
            return (fine,)
        wholes = [self.wholes[part] for part in fine.arguments]
        if not fine.is_positive and any(len(self.components[whole]) > 1 for whole in wholes):
            return ()
        return (Literal.of(coarse, wholes, fine.is_positive),)

    def counterpart(self, literal: Literal) -> tuple[tuple[Literal, ...], ...]:
        """The groups of fine literals each of which makes the coarse literal true.

        A fluent is true if its counterpart is true of some components, and false if it is false
        of all. What has no counterpart is its own.
        """
        coarse = Literal.parse(literal)
        if coarse.name not in self.counterparts:
            return ((coarse,),)
        name = self.counterparts[coarse.name]
        parts = product(*(self.components[constant] for constant in coarse.arguments))
        fine = tuple(Literal.of(name, args, coarse.is_positive) for args in parts)
        return tuple((found,) for found in fine) if coarse.is_positive else (fine,)
