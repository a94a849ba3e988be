"""One law at the fine resolution: its counterparts, and the variables that change with them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import chain, count
from typing import Any

from asp.language import syntax, variable_domains
from asp.language import variable_sorts as roles
from asp.refinement.language import COMPONENT, Vocabulary


class Renaming:
    """How the variables and constants of one coarse law are called where it is refined.

    A variable over magnified constants has a name for the component, in atoms with counterparts,
    and keeps its own for the whole, in all others; `links` tie together the two.
    """

    def __init__(self, law: syntax.Statement, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._domains = variable_domains(law, vocabulary.coarse)
        domains = self._domains.items()
        self._magnified = {v for v, own in domains if any(map(vocabulary.is_magnified, own))}
        self._taken = {*self._domains}
        self._fine: dict[str, syntax.Term] = {}
        self._wholes: dict[str, None] = {}
        self._others: list[syntax.Literal] = []
        inside = (atom for atom in _atoms(law) if atom.name in vocabulary.counterparts)
        self._inside = {t.name for atom in inside for t in atom.args if self.is_magnified(t)}

    def is_magnified(self, term: syntax.Term) -> bool:
        if term.is_variable:
            return term.name in self._magnified
        return self._vocabulary.is_magnified(term.name)

    def is_whole(self, atom: syntax.Atom) -> bool:
        """Whether the atom is an attribute of magnified constants that stays as it is."""
        others = self._vocabulary.coarse.symbols.keys() - self._vocabulary.counterparts.keys()
        return atom.name in others and any(map(self.is_magnified, atom.args))

    def is_about_wholes(self, law: syntax.ExecutabilityCondition) -> bool:
        """Whether a condition is about some wholes and not others, which their components share.

        It is where it names an attribute that stays as it is, a part of a magnified sort, or a
        magnified constant.
        """
        sides = (t for c in roles.comparisons(law.body) for t in c.terms)
        terms = (t for atom in (*law.actions, *_atoms(law)) for t in atom.args)
        return any(self.is_whole(atom) or self._is_part(atom) for atom in _atoms(law)) or any(
            self.is_magnified(t) and not t.is_variable for t in (*sides, *terms)
        )

    def _is_part(self, atom: syntax.Atom) -> bool:
        """Whether the atom is a sort that has some of the constants of a magnified one only."""
        sorts = self._vocabulary.coarse.sorts
        own, wholes = sorts.get(atom.name), [sorts[each] for each in self._vocabulary.magnified]
        return own is not None and any(set(own) < set(members) for members in wholes)

    def atom(self, atom: syntax.Atom) -> syntax.Atom:
        """The counterpart of an atom that has one; another atom as it is, about the wholes."""
        if atom.name in self._vocabulary.counterparts:
            name = self._vocabulary.counterparts[atom.name]
            return replace(atom, name=name, args=tuple(map(self.fine, atom.args)))
        if atom.name in self._vocabulary.coarse.sorts and self._is_only_inside(atom.args[0]):
            name = self._vocabulary.fine_sort(atom.name)
            return replace(atom, name=name, args=(self.fine(atom.args[0]),))
        self.note(atom.args)
        return atom

    def literal(self, literal: syntax.Literal) -> syntax.Literal:
        return replace(literal, atom=self.atom(literal.atom))

    def body(self, body: syntax.Body) -> syntax.Body:
        return tuple(
            self.literal(part) if isinstance(part, syntax.Literal) else self._comparison(part)
            for part in body
        )

    def fine(self, term: syntax.Term) -> syntax.Term:
        """The component in a counterpart's place: a variable of its own, or what is not magnified.

        A magnified constant stands for any of its components, so that a variable takes its place.
        """
        if not self.is_magnified(term):
            return term
        if not term.is_variable:
            self._wholes[term.name] = None
        if term.name not in self._fine:
            self._fine[term.name] = replace(term, name=self._new_name(term))
        return self._fine[term.name]

    def another(self, term: syntax.Term) -> syntax.Term:
        """A further component of the whole to which the term's component belongs."""
        self.fine(term)
        self._wholes[term.name] = None
        other = replace(term, name=self._new_name(term))
        self._others.append(component(other, term))
        return other

    def note(self, terms: Iterable[syntax.Term]) -> None:
        """Notes the wholes among terms of which a law speaks: their components are tied to them."""
        self._wholes |= {term.name: None for term in terms if self.is_magnified(term)}

    def links(self) -> syntax.Body:
        """`component(P, O)` for every whole of which the law names a component."""
        tied = [(self._fine[name], name) for name in self._wholes if name in self._fine]
        links = (component(part, replace(part, name=name)) for part, name in tied)
        return (*links, *self._others)

    def _is_only_inside(self, term: syntax.Term) -> bool:
        return self.is_magnified(term) and term.name in self._inside

    def _comparison(self, comparison: syntax.Comparison) -> syntax.Comparison:
        sides = comparison.terms
        if all(side.is_variable and self._is_only_inside(side) for side in sides):
            left, right = map(self.fine, sides)
            return replace(comparison, left=left, right=right)
        self.note(sides)
        return comparison

    def _new_name(self, term: syntax.Term) -> str:
        """The initial of the fine sort, with the number of the variable that it stands for."""
        letter = self._initial(term)
        digits = term.name[len(term.name.rstrip("0123456789")) :] if term.is_variable else ""
        candidates = chain([letter + digits], (f"{letter}{number}" for number in count(1)))
        name = next(candidate for candidate in candidates if candidate not in self._taken)
        self._taken.add(name)
        return name

    def _initial(self, term: syntax.Term) -> str:
        """That of the magnified sort's fine sort; over a mixed sort the variable's own."""
        vocabulary = self._vocabulary
        members = self._domains[term.name] if term.is_variable else (term.name,)
        for sort, fine in vocabulary.magnified.items():
            if set(members) <= set(vocabulary.coarse.sorts[sort]):
                return fine[0].upper()
        return term.name[0]


def component(part: syntax.Term, whole: syntax.Term) -> syntax.Literal:
    """`component(part, whole)`."""
    return syntax.Literal(syntax.Atom(COMPONENT, (part, whole), part.place), True)


def _atoms(law: syntax.Statement) -> Iterator[syntax.Atom]:
    return (use.atom for use in roles.uses(law))


Effect = tuple[syntax.Literal, syntax.Body]


def effects_of(action: syntax.Atom, coarse: syntax.Source) -> list[Effect]:
    """What the coarse action causes and under which conditions, in the terms of this atom."""
    found = ((law, _matched(law.action, action)) for law in coarse.each(syntax.CausalLaw))
    return [
        (_substituted(law.head, terms), _substituted(law.body, terms))
        for law, terms in found
        if terms is not None
    ]


def _matched(of_law: syntax.Atom, action: syntax.Atom) -> dict[str, syntax.Term] | None:
    """The terms for the variables of a causal law's action that make it the given one."""
    if of_law.name != action.name:
        return None
    terms: dict[str, syntax.Term] = {}
    for variable, term in zip(of_law.args, action.args, strict=True):
        if not variable.is_variable:
            if not term.is_variable and term.name != variable.name:
                return None
        elif terms.setdefault(variable.name, term).name != term.name:
            return None
    return terms


def _substituted(part: Any, terms: Mapping[str, syntax.Term]) -> Any:
    """A part of a law with these terms for the variables of its action.

    Another variable gets a name of the effect's own.
    """
    if isinstance(part, tuple):
        return tuple(_substituted(each, terms) for each in part)
    if isinstance(part, syntax.Term):
        own = replace(part, name=f"{part.name}_")
        return terms.get(part.name, own) if part.is_variable else part
    inside = {"atom", "args", "left", "right"} & vars(part).keys()
    return replace(part, **{name: _substituted(getattr(part, name), terms) for name in inside})
