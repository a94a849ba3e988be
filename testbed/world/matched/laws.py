"""The laws of a description as patterns, each found by what could make it matter."""

from collections import defaultdict
from dataclasses import replace

from asp.language import Facts, Pattern, Signature, pattern_of, reachable, syntax
from asp.language import variable_sorts as roles

Sign = tuple[str, bool]
"""The name of a literal, and whether it is positive."""


class Laws:
    """Every law of a description, compiled."""

    def __init__(self, source: syntax.Source, signature: Signature, statics: Facts) -> None:
        self._signature = signature
        self._statics = statics
        self.effects: dict[str, list[Pattern]] = defaultdict(list)
        """Causal laws by the name of the action, which is given."""
        self.prohibitions: list[tuple[tuple[str, ...], Pattern]] = []
        """The actions that a law forbids together, by name; their arguments are given."""
        self.sights: list[Pattern] = []
        """What is seen by a robot, which is given."""
        self.consequences: dict[Sign, list[Pattern]] = defaultdict(list)
        """Constraints by a literal of the body, which is given; a negative head must be possible as
        an atom: else it holds already."""
        self.grounds: dict[Sign, list[Pattern]] = defaultdict(list)
        """Those of them that define a fluent, likewise."""
        self.supports: dict[Sign, list[Pattern]] = defaultdict(list)
        """Constraints by their head, which is given."""
        self.constraints: list[Pattern] = []
        """Constraints with nothing given, a negative head as for `consequences`."""
        self.groundless: list[Pattern] = []
        """Those of them that need no true atom: they may apply where nothing is true."""
        for law in source.each(syntax.CausalLaw):
            pattern = pattern_of(law, signature, statics, law.action.args, law.head)
            self.effects[law.action.name].append(pattern)
        for condition in source.each(syntax.ExecutabilityCondition):
            given = [term for action in condition.actions for term in action.args]
            names = tuple(action.name for action in condition.actions)
            pattern = pattern_of(condition, signature, statics, given)
            self.prohibitions.append((names, pattern))
        for sight in source.each(syntax.SeesStatement):
            seen = syntax.Literal(sight.fluent, True)
            self.sights.append(pattern_of(sight, signature, statics, [sight.robot], seen))
        for constraint in source.each(syntax.StateConstraint):
            if signature.symbols[constraint.head.atom.name].kind != "static":
                self._add_constraint(constraint)
        self.defined = frozenset(n for n, s in signature.symbols.items() if s.kind == "defined")
        """The names of the defined fluents."""
        self.wavering = self._wavering()
        """The defined fluents that may fall by nothing but their own falling."""

    def _add_constraint(self, law: syntax.StateConstraint) -> None:
        head = law.head

        def pattern(given: tuple[syntax.Term, ...], *also: syntax.Literal) -> Pattern:
            return pattern_of(law, self._signature, self._statics, given, head, also)

        news = () if head.positive else (replace(head, positive=True),)
        kinds = {name: symbol.kind for name, symbol in self._signature.symbols.items()}
        fluents = [c for c in roles.literals(law.body) if kinds.get(c.atom.name) in roles.FLUENTS]
        for condition in fluents:
            key = condition.atom.name, condition.positive
            self.consequences[key].append(consequence := pattern(condition.atom.args, *news))
            if kinds[head.atom.name] == "defined":
                self.grounds[key].append(consequence)
        self.supports[head.atom.name, head.positive].append(pattern(head.atom.args))
        self.constraints.append(anywhere := pattern((), *news))
        if not any(condition.positive for condition in fluents):
            self.groundless.append(anywhere)

    def _wavering(self) -> frozenset[str]:
        """Those whose negation derives, by their names, what takes their derivation away.

        With `d if f` and `-f if -d` both values of d and f are outcomes of doing nothing.
        """
        first = {sign: {p.head for p in patterns} for sign, patterns in self.consequences.items()}
        after = defaultdict(set, {sign: set(heads) for sign, heads in first.items()})
        for (name, positive), defining in self.grounds.items():
            after[name, not positive] |= {(pattern.head[0], False) for pattern in defining}
        return frozenset(
            name
            for name in self.defined
            if any((name, False) in reachable(h, after) for h in first.get((name, False), ()))
        )
