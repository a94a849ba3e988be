"""A world compiled from a ground description: every instance of every law as bit masks.

A successor is the closure, under the state constraints, of the direct effects and of what inertia
keeps; a compound action without one cannot be executed.
"""

from collections.abc import Iterable, Iterator

from asp.language import Action, Description, Literal
from testbed.world.closure import Closure, LiteralSets, Rule
from testbed.world.world import Law, World


class CompiledWorld(World):
    """The backend for descriptions whose laws have few enough instances to write them down."""

    def __init__(self, description: Description) -> None:
        super().__init__(description, remembered=None)
        self._arguments = (description,)
        self._sets = LiteralSets(len(self.fluents))
        constraints = description.constraints
        self._constraints = tuple((self._mask(c.body), self._bit(c.head)) for c in constraints)
        self._closure = Closure(self._sets, self._constraints)
        self._inertial_fluents = self._mask(description.inertial)
        self._inertial = self._inertial_fluents | self._sets.complement(self._inertial_fluents)
        self._closed_world = self._sets.complement(self._mask(description.defined))
        self._effects: dict[str, list[Rule]] = {action: [] for action in self._actions}
        for law in description.causal:
            self._effects[law.action].append((self._mask(law.body), self._bit(law.head)))
        self._impossible: dict[str, list[tuple[int, frozenset[str], int]]] = {}
        for number, condition in enumerate(description.executability):
            own = number, frozenset(condition.actions), self._mask(condition.body)
            self._impossible.setdefault(min(condition.actions), []).append(own)
        self._sees: dict[str, list[Rule]] = {}
        for sight in description.sees:
            seen = self._mask(sight.body), self._bit(sight.fluent)
            self._sees.setdefault(sight.robot, []).append(seen)

    def is_state(self, state: int) -> bool:
        return state in self._states_with(self._sets.complete(state) & self._inertial)

    def states(self) -> Iterator[int]:
        return self._choose(0, self._inertial_fluents)

    def adjusted(self, state: int, literals: Iterable[Literal]) -> tuple[int, ...]:
        return self._changed(self._sets.complete(state), self._mask(literals))

    def _choose(self, chosen: int, undecided: int) -> Iterator[int]:
        """The states that extend the chosen literals by a value for each undecided fluent."""
        if not self._sets.consistent(self._closure.consequences(chosen)):
            return
        if not undecided:
            yield from self._states_with(chosen)
            return
        fluent = undecided & -undecided
        for literal in (fluent, self._sets.complement(fluent)):
            yield from self._choose(chosen | literal, undecided ^ fluent)

    def _states_with(self, inertial: int) -> tuple[int, ...]:
        """The states with these inertial literals: defined fluents are derived, else false."""
        models = self._closure.models(inertial, self._closed_world)
        return self._states_of(m for m in models if m & self._inertial == inertial)

    def _states_of(self, models: Iterable[int]) -> tuple[int, ...]:
        return tuple(sorted(model & self._sets.positive for model in models))

    def _completions(self, literals: tuple[Literal, ...]) -> Iterable[int]:
        facts = self._mask(literals)
        mentioned = facts | self._sets.complement(facts)
        left_out = self._sets.complement(self._sets.positive & ~mentioned)
        return self._states_of(self._closure.models(facts, left_out))

    def _broken(self, literals: tuple[Literal, ...]) -> Law | None:
        known = self._closure.consequences(self._mask(literals))
        if self._sets.consistent(known):
            return None
        denied = self._sets.complement(known)
        for law, (body, head) in zip(self.description.constraints, self._constraints, strict=True):
            if not body & ~known and head & denied:
                return (law.head,), law.body
        raise AssertionError("a contradiction follows from a law")

    def _transitions(self, state: int, compound: frozenset[Action]) -> tuple[int, ...]:
        literals = self._sets.complete(state)
        if next(self._forbidden(literals, compound), None) is not None:
            return ()
        effects = 0
        for action in compound:
            effects |= _fired(self._effects[action], literals)
        return self._changed(literals, effects)

    def _changed(self, literals: int, effects: int) -> tuple[int, ...]:
        """What the effects make of a state: what is inertial stays if it can."""
        defaults = literals & self._inertial | self._closed_world
        return self._states_of(self._closure.models(effects, defaults))

    def _forbidding(self, state: int, compound: frozenset[Action]) -> Iterator[Law]:
        for number in sorted(self._forbidden(self._sets.complete(state), compound)):
            law = self.description.executability[number]
            yield law.actions, law.body

    def _forbidden(self, literals: int, compound: frozenset[Action]) -> Iterator[int]:
        """The numbers of the laws that make the compound action impossible."""
        for action in compound:
            for number, actions, body in self._impossible.get(action, ()):
                if body & literals == body and actions <= compound:
                    yield number

    def _seen(self, state: int, robot: str) -> int:
        return _fired(self._sees.get(robot, ()), self._sets.complete(state))

    def _bit(self, literal: Literal) -> int:
        return self._sets.literal(*self._numbered(literal))

    def _mask(self, literals: Iterable[Literal]) -> int:
        mask = 0
        for literal in literals:
            mask |= self._bit(literal)
        return mask


def _fired(rules: Iterable[Rule], literals: int) -> int:
    """The heads of the rules whose body is among the literals."""
    heads = 0
    for body, head in rules:
        if body & literals == body:
            heads |= head
    return heads
