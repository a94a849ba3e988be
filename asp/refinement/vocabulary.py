"""What a refinement's text says of names: fine sorts, components and counterparts."""

from collections.abc import Mapping
from dataclasses import dataclass

from asp.language import Problems, Signature, suggestion, syntax
from asp.refinement.language import Components, Counterpart, Magnification

PREFIX = "fine_"
COMPONENT = "component"
FINE, COARSE = "fine", "coarse"


@dataclass(frozen=True)
class Vocabulary:
    """The names of both resolutions.

    `magnified` maps the sorts that are magnified to their fine sorts, `components` the constants
    of the coarse description to their components (a constant that is not magnified is its own),
    `counterparts` the symbols that have a counterpart to its name.
    """

    coarse: Signature
    magnified: Mapping[str, str]
    components: Mapping[str, tuple[str, ...]]
    counterparts: Mapping[str, str]

    def is_magnified(self, constant: str) -> bool:
        return any(constant in self.coarse.sorts[sort] for sort in self.magnified)

    def touches(self, sort: str) -> bool:
        """Whether a coarse sort has a magnified constant."""
        return any(map(self.is_magnified, self.coarse.sorts[sort]))

    def fine_sort(self, sort: str) -> str:
        """The fine counterpart of a coarse sort; the sort itself if nothing in it is magnified."""
        if sort in self.magnified:
            return self.magnified[sort]
        return PREFIX + sort if self.touches(sort) else sort

    def fine_members(self, sort: str) -> tuple[str, ...]:
        """The components of a coarse sort's constants, in their order."""
        found = (part for whole in self.coarse.sorts[sort] for part in self.components[whole])
        return tuple(dict.fromkeys(found))

    def fine_sorts(self, symbol: str) -> tuple[str, ...]:
        """The sorts of the arguments of a symbol's counterpart."""
        return tuple(self.fine_sort(sort.name) for sort in self.coarse.symbols[symbol].sorts)

    def bridged(self) -> tuple[str, ...]:
        """The coarse sorts whose constants stand in `component`: those that are refined."""
        found = (
            sort.name
            for symbol in self.counterparts
            for sort in self.coarse.symbols[symbol].sorts
            if self.touches(sort.name)
        )
        return tuple(dict.fromkeys([*self.magnified, *found]))


def vocabulary_of(fine: syntax.Source, coarse: Signature, problems: Problems) -> Vocabulary:
    """The names of both resolutions. Reports what is unknown, stated twice or missing."""
    magnified = _magnified(fine, coarse, problems)
    components = _components(fine, coarse, magnified, problems)
    counterparts = _counterparts(fine, coarse, problems)
    _check_use(fine, coarse, magnified, counterparts, problems)
    return Vocabulary(coarse, magnified, components, counterparts)


def _magnified(fine: syntax.Source, coarse: Signature, problems: Problems) -> dict[str, str]:
    found: dict[str, str] = {}
    owners: dict[str, str] = {}
    taken = {*coarse.sorts, *coarse.symbols, COMPONENT, FINE, COARSE}
    for statement in fine.each(Magnification):
        name = statement.sort.name
        if name not in coarse.sorts:
            known = suggestion(name, coarse.sorts)
            problems.report(statement.sort.place, f"unknown sort '{name}'; {known}")
            continue
        twice = next((c for c in coarse.sorts[name] if c in owners), None)
        if twice is not None:
            problems.report(
                statement.place, f"'{twice}' is magnified already, as one of '{owners[twice]}'"
            )
        elif statement.into in taken:
            problems.report(
                statement.place, f"the name '{statement.into}' is taken; the fine sort is a new one"
            )
        else:
            found[name] = statement.into
            taken.add(statement.into)
            owners.update(dict.fromkeys(coarse.sorts[name], name))
    return found


def _components(
    fine: syntax.Source, coarse: Signature, magnified: Mapping[str, str], problems: Problems
) -> dict[str, tuple[str, ...]]:
    """The components of every coarse constant; one that is not listed is its own component."""
    magnifiable = {c for sort in magnified for c in coarse.sorts[sort]}
    listed: dict[str, Components] = {}
    owners: dict[str, str] = {}
    for statement in fine.each(Components):
        whole = statement.whole.name
        if whole not in magnifiable:
            unknown = f"unknown constant '{whole}'; {suggestion(whole, magnifiable)}"
            none = f"'{whole}' is of no magnified sort, so that it has no components"
            problems.report(statement.whole.place, none if whole in coarse.constants else unknown)
        elif whole in listed:
            line = listed[whole].place.line
            problems.report(
                statement.place, f"the components of '{whole}' are listed in line {line} already"
            )
        else:
            listed[whole] = statement
            _claim(statement, owners, coarse, problems)
    return {
        constant: tuple(part.name for part in listed[constant].parts)
        if constant in listed
        else (constant,)
        for members in coarse.sorts.values()
        for constant in members
    }


def _claim(
    statement: Components, owners: dict[str, str], coarse: Signature, problems: Problems
) -> None:
    """Each component belongs to one constant, and is none of the coarse description itself."""
    if not statement.parts:
        problems.report(statement.place, f"'{statement.whole.name}' has no components")
    for part in statement.parts:
        if part.name in owners:
            problems.report(
                part.place, f"'{part.name}' is listed twice, first for '{owners[part.name]}'"
            )
        elif part.name in coarse.constants:
            problems.report(part.place, f"the name '{part.name}' is one of the coarse constants")
        owners.setdefault(part.name, statement.whole.name)


def _counterparts(fine: syntax.Source, coarse: Signature, problems: Problems) -> dict[str, str]:
    found: dict[str, str] = {}
    for statement in fine.each(Counterpart):
        name = statement.symbol.name
        if name not in coarse.symbols:
            known = suggestion(name, coarse.symbols)
            problems.report(statement.place, f"unknown static, fluent or action '{name}'; {known}")
        elif name in found:
            problems.report(statement.place, f"'{name}' is listed twice")
        elif PREFIX + name in coarse.symbols or PREFIX + name in coarse.sorts:
            problems.report(statement.place, f"the coarse description has a '{PREFIX + name}'")
        else:
            found[name] = PREFIX + name
    return found


def _check_use(
    fine: syntax.Source,
    coarse: Signature,
    magnified: Mapping[str, str],
    counterparts: Mapping[str, str],
    problems: Problems,
) -> None:
    """A magnified sort has components and is used; a counterpart is about something magnified."""
    listed = {statement.whole.name for statement in fine.each(Components)}
    constants = {sort: set(coarse.sorts[sort]) for sort in magnified}
    for statement in fine.each(Magnification):
        if statement.sort.name in magnified and not constants[statement.sort.name] & listed:
            problems.report(
                statement.place, f"no constant of sort '{statement.sort.name}' has components"
            )
    magnifiable = set().union(*constants.values())
    for counterpart in fine.each(Counterpart):
        if counterpart.symbol.name in counterparts:
            sorts = coarse.symbols[counterpart.symbol.name].sorts
            if not any(magnifiable & set(coarse.sorts[sort.name]) for sort in sorts):
                name = counterpart.symbol.name
                problems.report(counterpart.place, f"'{name}' has no argument of a magnified sort")
    for name in (COMPONENT, FINE, COARSE):
        if name in coarse.sorts or name in coarse.symbols:
            declared = fine.statements[0].place if fine.statements else syntax.Place(1, 1)
            problems.report(declared, f"the coarse description has a '{name}'; call it otherwise")
