"""Whether the fine map fits the coarse one, so that every coarse action can be carried out.

A map is a static with a counterpart that an action needs: it stands negated in an executability
condition, as `next_to` does where nothing moves between places that are not next to each other.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

from asp.language import Literal, functions, reachable, syntax
from asp.language import variable_sorts as roles
from asp.refinement.language import Components, Magnification, Mistakes, Vocabulary

Pairs = frozenset[tuple[str, str]]


def map_mistakes(
    fine: syntax.Source, coarse: syntax.Source, vocabulary: Vocabulary, statics: frozenset[Literal]
) -> Mistakes:
    """Where a fine map does not fit the coarse one, and wholes whose parts could part.

    The places are those of the refinement's text.
    """
    for static in _ways(coarse, vocabulary):
        yield from _Map(static, fine, vocabulary, statics).mistakes()
    yield from _parting(fine, coarse, vocabulary)


def _parting(fine: syntax.Source, coarse: syntax.Source, vocabulary: Vocabulary) -> Mistakes:
    """Wholes in one place at most, of whose components nothing says that they share it."""
    said = {law.head.atom.name for law in fine.each(syntax.StateConstraint) if law.head.positive}
    listed = {statement.whole.name: statement.place for statement in fine.each(Components)}
    for name, function in functions(coarse, vocabulary.coarse).items():
        counterpart = vocabulary.counterparts.get(name)
        sorts = function.others(vocabulary.coarse.symbols[name].sorts)
        members = (member for sort in sorts for member in vocabulary.coarse.sorts[sort.name])
        whole = next((one for one in members if len(vocabulary.components[one]) > 1), None)
        if whole is not None and counterpart is not None and counterpart not in said:
            several = f"has one value of '{name}' at most, and its components could have several"
            add = f"add a law by which they share '{counterpart}'"
            yield listed[whole], f"'{whole}' {several}; {add}"


def _ways(coarse: syntax.Source, vocabulary: Vocabulary) -> list[str]:
    """The statics of two magnified places that an action with a counterpart needs."""
    found = (
        literal.atom.name
        for law in coarse.each(syntax.ExecutabilityCondition)
        if any(action.name in vocabulary.counterparts for action in law.actions)
        for literal in roles.literals(law.body)
        if not literal.positive and _is_way(literal.atom.name, vocabulary)
    )
    return list(dict.fromkeys(found))


def _is_way(symbol: str, vocabulary: Vocabulary) -> bool:
    if symbol not in vocabulary.counterparts:
        return False
    declaration = vocabulary.coarse.symbols[symbol]
    touched = [vocabulary.touches(sort.name) for sort in declaration.sorts]
    return declaration.kind == "static" and touched == [True, True]


def _pairs(static: str, statics: Iterable[Literal]) -> Pairs:
    return frozenset((s.arguments[0], s.arguments[1]) for s in statics if s.name == static)


class _Map:
    """A coarse map, and what has to be so in the fine one."""

    def __init__(
        self, static: str, fine: syntax.Source, vocabulary: Vocabulary, statics: frozenset[Literal]
    ) -> None:
        self._static, self._counterpart = static, vocabulary.counterparts[static]
        self._coarse, self._fine = _pairs(static, statics), _pairs(self._counterpart, statics)
        sorts = vocabulary.coarse.symbols[static].sorts
        members = (member for sort in sorts for member in vocabulary.coarse.sorts[sort.name])
        self._components = {whole: vocabulary.components[whole] for whole in members}
        self._wholes = list(self._components)
        self._owner = {part: whole for whole, parts in self._components.items() for part in parts}
        self._anywhere = next(fine.each(Magnification)).place
        lists = list(fine.each(Components))
        self._listed = {listed.whole.name: listed.place for listed in lists}
        self._listed |= {part.name: part.place for listed in lists for part in listed.parts}
        atoms = [fact.literal.atom for fact in fine.each(syntax.Fact)]
        named = {term.name for atom in atoms for term in atom.args}
        self._stated = {
            tuple(term.name for term in atom.args): atom.place
            for atom in reversed(atoms)
            if atom.name == self._counterpart
        }
        alone = {whole for whole, parts in self._components.items() if parts == (whole,)}
        self._lost = alone - named

    def mistakes(self) -> Mistakes:
        """Where the fine map does not fit the coarse one, and how."""
        for whole in sorted(self._lost):
            yield self._place(whole), f"'{whole}' has no components, and no fact speaks of it"
        for whole, parts in self._components.items():
            for part, one, other in _apart(parts, self._fine):
                message = f"'{one}' cannot be reached from '{other}' inside '{whole}'"
                yield self._place(part), message
        for whole, one, other in _apart(self._wholes, self._coarse):
            if whole not in self._lost:
                message = f"'{one}' cannot be reached from '{other}' by {self._static}"
                yield self._place(whole), message
        yield from self._unconnected()
        yield from self._too_many()

    def _place(self, constant: str) -> syntax.Place:
        return self._listed.get(constant, self._anywhere)

    def _unconnected(self) -> Mistakes:
        """Where the coarse map has a way there is one between components."""
        ways = {(self._owner[one], self._owner[other]) for one, other in self._fine}
        missing = {(a, b) for a, b in self._coarse - ways if a != b and not self._lost & {a, b}}
        for one, other in _once(missing, self._wholes):
            none = f"no component of '{one}' is {self._counterpart} to one of '{other}'"
            yield self._place(one), f"{self._static}({one}, {other}), but {none}"

    def _too_many(self) -> Mistakes:
        """A way between components of two wholes that have none between them."""
        owner = self._owner
        crossing = {(a, b): (owner[a], owner[b]) for a, b in self._fine if owner[a] != owner[b]}
        wrong = {pair for pair, wholes in crossing.items() if wholes not in self._coarse}
        stated = [pair for pair in sorted(wrong) if pair in self._stated]
        order = [part for pair in stated for part in pair] + sorted(owner)
        for one, other in _once(wrong, order):
            whole, beyond = crossing[one, other]
            place = self._stated.get((one, other), self._place(one))
            leads = f"{self._counterpart}({one}, {other}) leads from '{whole}' to '{beyond}'"
            yield place, f"{leads}, but {self._static}({whole}, {beyond}) does not hold"


def _apart(members: Sequence[str], ways: Pairs) -> Iterator[tuple[str, str, str]]:
    """The members between which and the first there is no way inside, there or back.

    Each with the one that cannot be reached, and the one from which it cannot.
    """
    there, back = defaultdict[str, set[str]](set), defaultdict[str, set[str]](set)
    for one, other in ways:
        if {one, other} <= set(members):
            there[one].add(other)
            back[other].add(one)
    first, *others = members
    onward, homeward = reachable(first, there), reachable(first, back)
    for member in others:
        if member not in onward:
            yield member, member, first
        elif member not in homeward:
            yield member, first, member


def _once(pairs: set[tuple[str, str]], order: list[str]) -> list[tuple[str, str]]:
    """The pairs in this order of their members, one of two that are each other turned round."""
    rank = {name: number for number, name in reversed(list(enumerate(order)))}
    ordered = sorted(pairs, key=lambda pair: (rank[pair[0]], rank[pair[1]]))
    return [(a, b) for a, b in ordered if (b, a) not in pairs or rank[a] < rank[b]]
