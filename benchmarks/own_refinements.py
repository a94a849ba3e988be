"""Random refinements of random domains, with a state to begin with and a goal: `OwnTrial`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from random import Random

from benchmarks.own_domains import Domain, random_domain

_FINE = {"spot": "patch", "thing": "chunk"}


@dataclass(frozen=True)
class Refined:
    """What is magnified in a domain; `left_out` are the lines that its text does not have.

    `parts` has the components of the constants of magnified sorts. `shares` says that the parts of
    a thing are in one place.
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
            ("magnify", [f"{sort} into {_FINE[sort]}." for sort in self.magnified]),
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
        domain, spots, things = self.domain, "spot" in self.magnified, "thing" in self.magnified
        if spots:
            yield "path"
            yield domain.of_beast
            yield "go"
        if spots or things:
            yield from () if spots and not domain.apart else (domain.of_thing,)
            yield "drift"
        if domain.pushes:
            yield "push"
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


@dataclass(frozen=True)
class OwnTrial:
    """A refined domain, true fluents to begin with at both resolutions, and a goal."""

    refined: Refined
    coarse: tuple[str, ...]
    fine: tuple[str, ...]
    goal: tuple[str, ...]
    is_whole: bool


def random_trial(random: Random) -> OwnTrial:
    """One of many; not `is_whole` where a line of the refinement has been left out."""
    refined = _random_refinement(random_domain(random), random)
    beginning = _beginning(refined, random)
    coarse, fine = (tuple(beginning.literals(refined, each)) for each in (False, True))
    goal = tuple(_goal(refined.domain, random))
    is_whole = random.random() < 0.75
    if not is_whole:
        refined = replace(refined, left_out=(random.choice(refined.lines),))
    return OwnTrial(refined, coarse, fine, goal, is_whole)


def _random_refinement(domain: Domain, random: Random) -> Refined:
    choices = [("spot",), ("spot", "thing")] + ([("thing",)] if domain.apart else [])
    magnified = random.choice(choices)
    parts: dict[str, tuple[str, ...]] = {}
    if "spot" in magnified:
        parts |= {spot: _parts(spot, 3, random) for spot in domain.spots}
    if "thing" in magnified:
        parts |= {thing: _parts(thing, 2, random) for thing in domain.things}
    for sort, members in (("spot", domain.spots), ("thing", domain.things)):
        if sort in magnified and all(parts[member] == (member,) for member in members):
            parts[members[0]] = (f"{members[0]}_a", f"{members[0]}_b")
    doors = tuple(
        (random.choice(parts[a]), random.choice(parts[b]))
        for a, b in domain.paths
        if "spot" in magnified
    )
    return Refined(domain, magnified, parts, doors)


def _parts(whole: str, most: int, random: Random) -> tuple[str, ...]:
    number = random.randint(1, most)
    if number == 1 and random.random() < 0.5:
        return (whole,)
    return tuple(f"{whole}_{letter}" for letter in "abc"[:number])


@dataclass(frozen=True)
class _Beginning:
    """Where everything is; what is gripped or tied is where its carrier is."""

    places: Mapping[str, str]
    gripped: str | None
    tied: str | None
    flooded: tuple[str, ...]

    def literals(self, refined: Refined, fine: bool) -> Iterator[str]:
        """The true fluents, at one of the resolutions."""
        domain, named = refined.domain, refined.counterparts if fine else ()
        parts = refined.parts if fine else {}
        wholes = {part: whole for whole, found in refined.parts.items() for part in found}

        def atom(name: str, *constants: str) -> str:
            told = constants if fine else (wholes.get(each, each) for each in constants)
            return f"{'fine_' if name in named else ''}{name}({','.join(told)})"

        for body, place in self.places.items():
            fluent = domain.of_thing if body in domain.things else domain.of_beast
            yield from (atom(fluent, part, place) for part in parts.get(body, (body,)))
        if self.gripped:
            yield atom("grips", "otter", parts.get(self.gripped, (self.gripped,))[0])
        if self.tied and domain.raft:
            yield atom("tied", *(parts.get(each, (each,))[0] for each in (self.tied, domain.raft)))
        yield from (f"flooded({spot})" for spot in self.flooded)


def _beginning(refined: Refined, random: Random) -> _Beginning:
    domain = refined.domain
    places = {}
    for body in ("otter", *domain.things):
        spot = random.choice(domain.spots)
        places[body] = random.choice(refined.parts.get(spot, (spot,)))
    gripped = domain.things[0] if domain.grips and random.random() < 0.3 else None
    tied = domain.nuts[-1] if domain.raft and random.random() < 0.4 else None
    tied = None if tied == gripped else tied
    if gripped:
        places[gripped] = places["otter"]
    if tied and domain.raft:
        places[tied] = places[domain.raft]
    flooded = tuple(spot for spot in domain.low if random.random() < 0.5)
    return _Beginning(places, gripped, tied, flooded)


def _goal(domain: Domain, random: Random) -> Iterator[str]:
    thing = random.choice(domain.things)
    spot = random.choice(domain.spots)
    wishes: Sequence[Sequence[str]] = [
        [f"{domain.of_thing}({thing},{spot})"],
        [f"{domain.of_thing}({thing},{spot})"],
        [f"{domain.of_beast}(otter,{spot})"],
        *([[f"grips(otter,{thing})"]] if domain.grips else []),
        *([[f"tied({domain.nuts[0]},{domain.raft})"]] if domain.raft else []),
        *([[f"-flooded({domain.low[0]})"]] if domain.low else []),
    ]
    wish = random.choice(wishes)
    yield from wish
    if domain.grips and wish[0].startswith(domain.of_thing) and random.random() < 0.5:
        yield f"-grips(otter,{thing})"
