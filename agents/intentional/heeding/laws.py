"""The laws of a domain as heeding asks for them: which fluents and constants a fluent is about."""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache

from asp.language import Action, Fluent, analyse, excluding_place, reachable, syntax
from asp.reasoning import knowledge
from asp.refinement import CoarseDomain
from asp.solving import preparation


class Laws:
    """The laws of one domain; `coarse` is what Definition 1 reads."""

    def __init__(self, name: str, source: str) -> None:
        self.coarse = CoarseDomain(*analyse(source, f"{name}.al"))
        self._description = knowledge(name, source).description

    def bearing_on(self, fluents: Iterable[Fluent]) -> frozenset[Fluent]:
        """The fluents, and those on which their values depend through laws on states.

        The laws are all state constraints and definitions, one after another; whether a condition
        is met, and with which sign it stands there, does not matter.
        """
        return frozenset(bearing for each in fluents for bearing in self._bearing(each))

    def conditions(self, actions: Iterable[Action]) -> frozenset[Fluent]:
        """The fluents in executability conditions of actions and in conditions of their effects."""
        return frozenset(fluent for action in actions for fluent in self._conditions[action])

    def is_about(self, fluent: Fluent, constants: Collection[str]) -> bool:
        """Whether all arguments of a fluent are among the constants.

        Of a function its value is not looked at, wherever it stands.
        """
        foreign = [n for n, own in enumerate(fluent.arguments) if own not in constants]
        return not foreign or any(foreign == [place] for place in self._values[fluent.name])

    def _bearing(self, fluent: Fluent) -> set[Fluent]:
        return reachable(fluent, self._dependencies)

    @cached_property
    def _dependencies(self) -> Mapping[Fluent, set[Fluent]]:
        """Of each fluent the conditions of the laws on states that conclude it or its contrary."""
        found: dict[Fluent, set[Fluent]] = defaultdict(set)
        for law in self._description.constraints:
            found[law.head.atom].update(condition.atom for condition in law.body)
        return found

    @cached_property
    def _conditions(self) -> Mapping[Action, set[Fluent]]:
        found: dict[Action, set[Fluent]] = defaultdict(set)
        for hindrance in self._description.executability:
            for action in hindrance.actions:
                found[action].update(condition.atom for condition in hindrance.body)
        for effect in self._description.causal:
            found[effect.action].update(condition.atom for condition in effect.body)
        return found

    @cached_property
    def _values(self) -> Mapping[str, Sequence[int]]:
        """The places of the values of each function, by its name."""
        found: dict[str, list[int]] = defaultdict(list)
        for law in self.coarse.coarse.each(syntax.StateConstraint):
            place = excluding_place(law)
            if place is not None:
                found[law.head.atom.name].append(place)
        return found


@lru_cache(maxsize=16)
def laws_of(name: str, source: str) -> Laws:
    """The laws of an AL_d text, read once."""
    with preparation():
        return Laws(name, source)
