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
            ("counterparts", [f"{name}." for name in self._counterparts()]),
            ("facts", list(self._facts())),
            ("laws", list(self._laws())),
            ("tests", list(self._tests())),
        ):
            yield section, [line for line in lines if line not in self.left_out]

    def _components(self) -> Iterator[str]:
        for whole, parts in self.parts.items():
            if parts != (whole,):
                yield f"{whole} = {{{', '.join(parts)}}}."

    def _counterparts(self) -> Iterator[str]:
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
        fine = {name: f"fine_{name}" for name in self._counterparts()}
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
    """A refined domain, true fluents to begin with at the fine resolution, and a goal."""

    refined: Refined
    initial: tuple[str, ...]
    goal: tuple[str, ...]
    is_whole: bool


def random_trial(random: Random) -> OwnTrial:
    """One of many; not `is_whole` where a line of the refinement has been left out."""
    refined = _random_refinement(random_domain(random), random)
    initial = tuple(_initial(refined, random))
    goal = tuple(_goal(refined.domain, random))
    if not refined.lines or random.random() < 0.75:
        return OwnTrial(refined, initial, goal, True)
    cut = replace(refined, left_out=(random.choice(refined.lines),))
    return OwnTrial(cut, initial, goal, False)


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


def _initial(refined: Refined, random: Random) -> Iterator[str]:
    """Where everything is; what is gripped or tied is where its carrier is."""
    domain = refined.domain
    place = {body: _place(refined, random) for body in ("otter", *domain.things)}
    gripped = domain.things[0] if domain.grips and random.random() < 0.3 else None
    tied = domain.nuts[-1] if domain.raft and random.random() < 0.4 else None
    if gripped:
        place[gripped] = place["otter"]
    if tied and domain.raft and tied != gripped:
        place[tied] = place[domain.raft]
    fine = frozenset(refined._counterparts())
    yield _atom(domain.of_beast, fine, "otter", place["otter"])
    for thing in domain.things:
        for part in refined.parts.get(thing, (thing,)):
            yield _atom(domain.of_thing, fine, part, place[thing])
    if gripped:
        yield _atom("grips", fine, "otter", refined.parts.get(gripped, (gripped,))[0])
    if tied and domain.raft and tied != gripped:
        one, other = (refined.parts.get(x, (x,))[0] for x in (tied, domain.raft))
        yield _atom("tied", fine, one, other)
    yield from (f"flooded({spot})" for spot in domain.low if random.random() < 0.5)


def _place(refined: Refined, random: Random) -> str:
    spot = random.choice(refined.domain.spots)
    return random.choice(refined.parts.get(spot, (spot,)))


def _atom(name: str, fine: frozenset[str], *constants: str) -> str:
    return f"{'fine_' if name in fine else ''}{name}({','.join(constants)})"


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
