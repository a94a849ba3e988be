"""Conjunctions with variables, compiled into nested loops over the atoms that are there.

A variable is a slot of a list (the environment of a match), a constant its name. What is cheapest
comes first: a condition all of whose variables are bound is tested, one that binds a variable by
way of an index follows, and only a variable that no positive literal binds runs over its sort.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from testbed.world.matched.facts import Facts, GroundAtom, Truth

Env: TypeAlias = list[str]
Emit: TypeAlias = Callable[[Env], bool]
"""What is done with a match; True ends the search. The environment is used again afterwards."""
Step: TypeAlias = Callable[[Env, Truth, Emit], bool]
Arg: TypeAlias = int | str
"""A slot, or a constant."""


@dataclass(frozen=True)
class Template:
    """An atom with slots; `domains` are what the slots at its places range over."""

    name: str
    args: tuple[Arg, ...]

    @property
    def slots(self) -> frozenset[int]:
        return frozenset(arg for arg in self.args if isinstance(arg, int))

    def ground(self, env: Env) -> GroundAtom:
        return (self.name, *[env[a] if isinstance(a, int) else a for a in self.args])


@dataclass(frozen=True)
class Membership:
    """A literal; a static one is asked of the statics, any other of the state."""

    atom: Template
    positive: bool
    static: bool

    @property
    def slots(self) -> frozenset[int]:
        return self.atom.slots


@dataclass(frozen=True)
class Sameness:
    """A comparison of two terms."""

    left: Arg
    right: Arg
    equal: bool

    @property
    def slots(self) -> frozenset[int]:
        return frozenset(arg for arg in (self.left, self.right) if isinstance(arg, int))


Condition: TypeAlias = Membership | Sameness


@dataclass(frozen=True)
class Scope:
    """What all the joins of a statement share: the members of each slot's sort, the statics."""

    domains: tuple[frozenset[str], ...]
    statics: Facts

    def unifier(
        self, template: Template, bound: frozenset[int]
    ) -> Callable[[GroundAtom, Env], bool]:
        """Whether a ground atom fits the template, given the bound slots; binds the others."""
        fixed, binds, repeats = [], [], []
        seen = set(bound)
        for place, arg in enumerate(template.args, start=1):
            if isinstance(arg, str):
                fixed.append((place, arg))
            elif arg in seen:
                repeats.append((place, arg))
            else:
                seen.add(arg)
                binds.append((place, arg, self.domains[arg]))

        def unify(atom: GroundAtom, env: Env) -> bool:
            for place, constant in fixed:
                if atom[place] != constant:
                    return False
            for place, slot, domain in binds:
                value = atom[place]
                if value not in domain:
                    return False
                env[slot] = value
            return not repeats or all(atom[place] == env[slot] for place, slot in repeats)

        return unify

    def join(
        self, conditions: Sequence[Condition], bound: frozenset[int], wanted: frozenset[int]
    ) -> Step:
        """The search for all that satisfies the conditions and binds the wanted slots."""
        if not conditions and wanted <= bound:
            return _emit
        for condition in conditions:
            if condition.slots <= bound:
                rest = self.join(_without(conditions, condition), bound, wanted)
                return self._test(condition, rest)
        source = self._cheapest(conditions, bound)
        if source is not None:
            rest = self.join(_without(conditions, source), bound | source.slots, wanted)
            return self._look_up(source, bound, rest)
        missing = wanted.union(*(c.slots for c in conditions)) - bound
        slot = min(missing, key=lambda s: (len(self.domains[s]), s))
        return self._run(slot, self.join(conditions, bound | {slot}, wanted))

    def _cheapest(
        self, conditions: Sequence[Condition], bound: frozenset[int]
    ) -> Membership | None:
        sources = [c for c in conditions if isinstance(c, Membership) and c.positive]
        return min(sources, key=lambda c: self._cost(c, bound), default=None)

    def _cost(self, condition: Membership, bound: frozenset[int]) -> float:
        """The atoms to look at: known of the statics, a guess for what changes."""
        keyed = self._keys(condition.atom, bound)
        if not condition.static:
            return 2 if keyed else 1000
        atoms = self.statics.named(condition.atom.name)
        values = [len({atom[place] for atom in atoms}) for place, _ in keyed]
        return len(atoms) / max(1, *values, 1)

    def _keys(self, atom: Template, bound: frozenset[int]) -> list[tuple[int, Arg]]:
        return [
            (place, arg)
            for place, arg in enumerate(atom.args, start=1)
            if isinstance(arg, str) or arg in bound
        ]

    def _look_up(self, source: Membership, bound: frozenset[int], then: Step) -> Step:
        """Binds slots by each atom that fits."""
        name, statics = source.atom.name, self.statics if source.static else None
        unify = self.unifier(source.atom, bound)
        keys = self._keys(source.atom, bound)
        place, key = keys[0] if keys else (0, "")

        def step(env: Env, truth: Truth, emit: Emit) -> bool:
            there: Truth = truth if statics is None else statics
            if place:
                found = there.having(name, place, env[key] if isinstance(key, int) else key)
            else:
                found = there.named(name)
            return any(unify(atom, env) and then(env, truth, emit) for atom in found)

        return step

    def _run(self, slot: int, then: Step) -> Step:
        """Binds a slot by every member of its sort."""
        members = sorted(self.domains[slot])

        def step(env: Env, truth: Truth, emit: Emit) -> bool:
            return any(_bind(env, slot, value) and then(env, truth, emit) for value in members)

        return step

    def _test(self, condition: Condition, then: Step) -> Step:
        if isinstance(condition, Sameness):
            return _compare(condition, then)
        ground, positive = condition.atom.ground, condition.positive
        if condition.static:
            holds = self.statics.may_hold
            return lambda env, truth, emit: (
                holds(ground(env)) == positive and then(env, truth, emit)
            )
        if positive:
            return lambda env, truth, emit: truth.may_hold(ground(env)) and then(env, truth, emit)
        return lambda env, truth, emit: truth.may_fail(ground(env)) and then(env, truth, emit)


def _compare(condition: Sameness, then: Step) -> Step:
    left, right, equal = condition.left, condition.right, condition.equal

    def step(env: Env, truth: Truth, emit: Emit) -> bool:
        one = env[left] if isinstance(left, int) else left
        other = env[right] if isinstance(right, int) else right
        return (one == other) == equal and then(env, truth, emit)

    return step


def _bind(env: Env, slot: int, value: str) -> bool:
    env[slot] = value
    return True


def _emit(env: Env, _truth: Truth, emit: Emit) -> bool:
    return emit(env)


def _without(conditions: Sequence[Condition], one: Condition) -> list[Condition]:
    rest = list(conditions)
    rest.remove(one)
    return rest
