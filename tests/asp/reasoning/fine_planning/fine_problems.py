"""Planning problems at the fine resolution, drawn, and an oracle that searches states."""

import random
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

from asp.language import (
    Action,
    Fluent,
    Literal,
    Problems,
    Signature,
    functions,
    signature_of,
    subject,
    syntax,
)
from asp.reasoning.fine_planning import FineStart
from asp.refinement import Refinement, Transition, fine_constants, fine_goal, relevant
from testbed.world import World, world_of
from tests.asp.refinement.levels import coarse_world
from tests.literals import parsed

_KNOWN, _HELD = 0.4, 0.4


@dataclass(frozen=True)
class FineProblem:
    """A refined transition: what is known of its first state, and the constants it is about."""

    refinement: Refinement
    start: FineStart
    transition: Transition
    relevant: frozenset[str]

    @property
    def goal(self) -> tuple[Literal, ...]:
        effects, _ = fine_goal(self.refinement, self.transition, self.relevant)
        return effects

    @property
    def constants(self) -> frozenset[str]:
        """Those of the zoomed description."""
        return self.relevant | fine_constants(self.refinement, self.relevant)


def drawn_problem(refinement: Refinement, draw: random.Random) -> FineProblem:
    """A transition possible in some coarse state of a level, with cells known or among some."""
    components, sorts = refinement.components, refinement.coarse_signature.sorts
    where = {thing: draw.choice(sorts["room"]) for thing in ("rob1", *sorts["object"])}
    held = draw.choice(sorts["object"]) if draw.random() < _HELD else None
    if held is not None:
        where[held] = where["rob1"]
    own = draw.choice(components[where["rob1"]])
    true, candidates = {Literal.of("fine_loc", ["rob1", own])}, []
    for thing in sorts["object"]:
        cells = components[where[thing]]
        some = sorted(draw.sample(cells, draw.randint(1, len(cells))), key=cells.index)
        if thing == held:
            some = [own]
            true.add(Literal.of("fine_in_hand", ["rob1", draw.choice(components[thing])]))
        certain = thing == held or (len(some) == 1 and draw.random() < _KNOWN)
        for part in components[thing]:
            group = parsed(f"fine_loc({part},{cell})" for cell in some)
            if certain:
                true.update(group)
            else:
                candidates.append(group)
    coarse = {Literal.of("loc", [thing, room]) for thing, room in where.items()}
    coarse |= {Literal.of("in_hand", ["rob1", held])} if held else set()
    goal = parsed([f"loc({draw.choice(sorts['object'])},{draw.choice(sorts['room'])})"])
    transition = _drawn_transition(refinement, frozenset(coarse), draw)
    about = relevant(refinement, transition, goal)
    return FineProblem(refinement, FineStart(frozenset(true), tuple(candidates)), transition, about)


def _drawn_transition(
    refinement: Refinement, before: frozenset[Fluent], draw: random.Random
) -> Transition:
    world = coarse_world(refinement)
    state = world.state(before)
    possible = [a for a in world.agent_actions if world.executable(state, [a])]
    # Moves are many, what is in reach and in hand is of as much interest.
    kind = draw.choice(sorted({action.name for action in possible}))
    action = draw.choice([a for a in possible if a.name == kind])
    return Transition(before, action, frozenset(world.true_atoms(world.successor(state, [action]))))


def drawn_state(refinement: Refinement, draw: random.Random) -> FineStart:
    """All of a state that some actions lead to from one in which everything is somewhere."""
    world = _world(refinement)
    values: dict[tuple[str, ...], list[Fluent]] = {}
    known = functions(refinement.weak, refinement.weak_signature)
    for fluent in world.description.inertial:
        place = subject(fluent, known)
        if place is not None:
            values.setdefault(place, []).append(fluent)
    together = {}  # parts of one thing are at one place
    for (name, *others), fluents in values.items():
        whole = tuple(refinement.wholes[constant] for constant in others)
        together[name, whole] = together.get((name, whole), draw.randrange(len(fluents)))
    state = world.state(
        fluents[together[name, tuple(refinement.wholes[c] for c in others)]]
        for (name, *others), fluents in values.items()
    )
    for _ in range(draw.randrange(12)):
        actions = [a for a in world.description.agent_actions if world.executable(state, [a])]
        exogenous = world.description.exogenous_actions
        actions += [a for a in exogenous if not draw.randrange(4) and world.executable(state, [a])]
        state = world.successor(state, [draw.choice(actions)])
    inertial = frozenset(world.description.inertial)
    return FineStart(inertial.intersection(world.true_atoms(state)))


def drawn_goal(refinement: Refinement, draw: random.Random) -> tuple[Literal, ...]:
    """One or two literals of either resolution."""
    fluents = draw.sample(_world(refinement).fluents, draw.choice([1, 1, 2]))
    return tuple(draw.choice([fluent, fluent.complement]) for fluent in fluents)


def signature(source: syntax.Source) -> Signature:
    return signature_of(source, Problems(source.file))


@cache
def _world(refinement: Refinement) -> World:
    return world_of(refinement)


def first_shortest(
    refinement: Refinement, start: FineStart, goal: Sequence[Literal], limit: int
) -> tuple[Action, ...] | None:
    """The first plan in the order of declaration, by layers of a breadth-first search.

    It starts from every state that the candidates allow.
    """
    world = _world(refinement)
    rank = {action: number for number, action in enumerate(world.agent_actions)}

    def order(plan: tuple[Action, ...]) -> list[int]:
        return [rank[action] for action in plan]

    plans: dict[int, tuple[Action, ...]] = dict.fromkeys(_states(refinement, start), ())
    seen = set(plans)
    for _ in range(limit + 1):
        reached = [plan for state, plan in plans.items() if world.satisfies(state, goal)]
        if reached or not plans:
            return min(reached, key=order, default=None)
        following: dict[int, tuple[Action, ...]] = {}
        for state, plan in sorted(plans.items(), key=lambda item: order(item[1])):
            for action in world.agent_actions:
                for after in world.successors(state, [action]):
                    if after not in seen:
                        following.setdefault(after, (*plan, action))
        seen |= following.keys()
        plans = following
    return None


def _states(refinement: Refinement, start: FineStart) -> list[int]:
    """The states that the candidates allow: parts of one thing are at one place."""
    groups: dict[str, list[tuple[Fluent, ...]]] = {}
    for group in start.candidates:
        part = group[0].arguments[0]
        groups.setdefault(refinement.wholes[part], []).append(group)
    places = [list(zip(*of_thing, strict=True)) for of_thing in groups.values()]
    return [_world(refinement).state(start.true.union(*chosen)) for chosen in product(*places)]
