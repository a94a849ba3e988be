"""Refinements of the domains of `benchmarks.own_domains`."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

from benchmarks.own_domains import Domain

FINE_SORTS = {"spot": "patch", "thing": "chunk", "nut": "kernel", "raft": "plank"}


@dataclass(frozen=True)
class Refined:
    """What is magnified in a domain; `left_out` are the lines that its text does not have.

    `parts` has the components of the constants of magnified sorts.
    """

    domain: Domain
    magnified: tuple[str, ...]
    parts: Mapping[str, tuple[str, ...]]
    doors: tuple[tuple[str, str], ...]
    left_out: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """The text of the refinement."""
        sections = "\n".join(
            f"{section}\n" + "\n".join(f"  {line}" for line in lines)
            for section, lines in self._sections()
            if lines
        )
        return f'refines "own.al".\n{sections}\n'

    @property
    def lines(self) -> list[str]:
        """The lines that could be left out."""
        able = ("counterparts", "facts", "laws", "tests")
        return [line for section, lines in self._sections() if section in able for line in lines]

    def _sections(self) -> Iterator[tuple[str, list[str]]]:
        for section, lines in (
            ("magnify", [f"{sort} into {FINE_SORTS[sort]}." for sort in self.magnified]),
            ("components", list(self._components())),
            ("counterparts", [f"{name}." for name in self.counterparts]),
            ("facts", list(self._facts())),
            ("laws", list(self._laws())),
            ("tests", list(self._tests())),
        ):
            yield section, [line for line in lines if line not in self.left_out]

    def _components(self) -> Iterator[str]:
        for whole, parts in self.parts.items():
            if parts != (whole,):
                yield f"{whole} = {{{', '.join(parts)}}}."

    @property
    def counterparts(self) -> tuple[str, ...]:
        """The attributes and actions that are about magnified constants."""
        return tuple(self._named())

    def _named(self) -> Iterator[str]:
        domain, spots = self.domain, "spot" in self.magnified
        things = any(thing in self.parts for thing in domain.things)
        if spots:
            yield "path"
            yield domain.of_beast
            yield "go"
        if spots or things:
            yield from () if spots and not domain.apart else (domain.of_thing,)
            yield "drift"
        if domain.pushes:
            yield "push"
        if domain.manner == "near" and things:
            yield "near"
        if things and domain.grips:
            yield from ("grips", "grip", "drop")
        if things and domain.raft:
            yield from ("tied", "tie", "untie")

    def _facts(self) -> Iterator[str]:
        if "spot" in self.magnified:
            for spot in self.domain.spots:
                yield from (f"fine_path({a}, {b})." for a, b in pairwise(self.parts[spot]))
            yield from (f"fine_path({a}, {b})." for a, b in self.doors)

    def _laws(self) -> Iterator[str]:
        if any(len(self.parts.get(thing, ())) > 1 for thing in self.domain.things):
            fluent = f"fine_{self.domain.of_thing}"
            yield f"{fluent}(X, P) if {fluent}(Y, P), component(X, T), component(Y, T)."

    def _tests(self) -> Iterator[str]:
        domain = self.domain
        fine = {name: f"fine_{name}" for name in self.counterparts}
        here, there = (fine.get(name, name) for name in (domain.of_beast, domain.of_thing))
        if domain.of_beast in fine:
            yield f"B tests {here}(X, P) if beast(B), {here}(B, P)."
        if domain.apart and domain.of_thing in fine:
            yield f"B tests {there}(X, P) if beast(B), {here}(B, P)."
        if "grips" in fine:
            yield "B tests fine_grips(B, T)."
        if "tied" in fine:
            yield f"B tests fine_tied(N, R) if beast(B), {here}(B, P), {there}(R, P)."
