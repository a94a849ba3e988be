"""Random refinements of random domains, with a state to begin with and a goal: `OwnTrial`."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from random import Random

from benchmarks.own_domains import Domain
from benchmarks.own_refinements import Refined

_SPOTS = ("glade", "marsh", "cliff", "cove")
_NUTS = ("acorn", "pebble", "reed")


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
    goal = tuple(_goals(refined.domain, random))
    is_whole = random.random() < 0.75
    if not is_whole:
        refined = replace(refined, left_out=(random.choice(refined.lines),))
    return OwnTrial(refined, coarse, fine, goal, is_whole)


def _random_refinement(domain: Domain, random: Random) -> Refined:
    sorts = {"spot": domain.spots, "thing": domain.things}
    if domain.raft:
        sorts |= {"nut": domain.nuts, "raft": (domain.raft,)}
    magnified = tuple(_magnified(domain, random))
    parts: dict[str, tuple[str, ...]] = {}
    for sort in magnified:
        most = 3 if sort == "spot" else 2
        parts |= {member: _parts(member, most, random) for member in sorts[sort]}
        if all(parts[member] == (member,) for member in sorts[sort]):
            first = sorts[sort][0]
            parts[first] = (f"{first}_a", f"{first}_b")
    doors = tuple(
        (random.choice(parts[a]), random.choice(parts[b]))
        for a, b in domain.paths
        if "spot" in magnified
    )
    return Refined(domain, magnified, parts, doors)


def _magnified(domain: Domain, random: Random) -> Iterator[str]:
    """Spots, things or some of them; things alone only where beasts are not at spots alike."""
    spots = not domain.apart or random.random() < 0.7
    if spots:
        yield "spot"
    if not spots or random.random() < 0.5:
        yield random.choice(("thing", "nut", "raft") if domain.raft else ("thing",))


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
    rest: tuple[str, ...]

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
        yield from self.rest


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
    rest = [f"flooded({spot})" for spot in domain.low if random.random() < 0.5]
    rest += ["dusk"] if domain.dusk and random.random() < 0.5 else []
    return _Beginning(places, gripped, tied, tuple(rest))


def _goals(domain: Domain, random: Random) -> Iterator[str]:
    """One wish, or spots for two things."""
    if len(domain.things) > 1 and random.random() < 0.2:
        for thing in domain.things[:2]:
            yield f"{domain.of_thing}({thing},{random.choice(domain.spots)})"
    else:
        yield from _goal(domain, random)


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
        *([["-dusk"]] if domain.dusk else []),
    ]
    wish = random.choice(wishes)
    yield from wish
    if domain.grips and wish[0].startswith(domain.of_thing) and random.random() < 0.5:
        yield f"-grips(otter,{thing})"


def random_domain(random: Random) -> Domain:
    """A domain of two to four spots and one to three things."""
    spots = _SPOTS[: random.randint(2, 4)]
    things = _NUTS[: random.randint(1, 3)]
    raft = things[-1] if len(things) > 1 and random.random() < 0.5 else None
    grips = random.random() < 0.7
    return Domain(
        spots=spots,
        paths=tuple(_paths(spots, random)),
        things=things,
        raft=raft,
        low=tuple(spot for spot in spots if random.random() < 0.2),
        apart=random.random() < 0.5,
        grips=grips,
        pushes=(not grips and random.random() < 0.6) or random.random() < 0.2,
        single=random.random() < 0.6,
        dusk=random.random() < 0.2,
        manner=random.choice(("apart", "apart", "near", "denied")),
    )


def _paths(spots: Sequence[str], random: Random) -> Iterator[tuple[str, str]]:
    """A tree, and now and then a path more."""
    found: set[tuple[str, str]] = set()
    for number, spot in enumerate(spots[1:], start=1):
        found.add((spots[random.randrange(number)], spot))
    for number, spot in enumerate(spots):
        found.update((other, spot) for other in spots[:number] if random.random() < 0.15)
    yield from sorted(found)
