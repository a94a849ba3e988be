"""The text of a refinement, which the designer adds to a description: parser and names."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from lark import Token, v_args
from lark.tree import Meta

from asp.language import Problems, Signature, ToSyntax, grammar, parse_with, suggestion, syntax
from asp.language import variable_sorts as roles

PREFIX = "fine_"
COMPONENT, FINE, COARSE = "component", "fine", "coarse"

Mistakes = Iterator[tuple[syntax.Place, str]]


class Refines(syntax.Statement):
    """`refines name.` or `refines "path".`: the coarse description."""

    name: str


class Magnification(syntax.Statement):
    """`sort into fine.`: the constants of a coarse sort have components, those of a fine one."""

    sort: syntax.Term
    into: str


class Components(syntax.Statement):
    """`whole = {part, part}.`"""

    whole: syntax.Term
    parts: tuple[syntax.Term, ...]


class Counterpart(syntax.Statement):
    """An attribute or action that gets a fine counterpart."""

    symbol: syntax.Term


class TestsStatement(syntax.Statement):
    """`robot tests fluent if body`: in which states the robot can test whether the fluent holds."""

    robot: syntax.Term
    fluent: syntax.Atom
    body: syntax.Body


roles.ROLES[TestsStatement] = {"fluent": (roles.FLUENTS, "a fluent after 'tests'")}


def parse_fine(text: str, file: str = "<text>") -> syntax.Source:
    """The statements of a refinement's text. Raises SourceError."""
    texts = "language/al.lark", "refinement/fine.lark"
    return parse_with(grammar("refinement", *texts), _ToRefinement(), text, file)


@v_args(meta=True)
class _ToRefinement(ToSyntax):
    """Builds the abstract syntax of a refinement bottom-up."""

    magnify = components_section = counterparts = tests_section = ToSyntax.section
    refinement = ToSyntax.start

    def refines(self, meta: Meta, children: list[Token]) -> list[syntax.Statement]:
        return [self.__default__("refines", [children[1].strip('"')], meta)]


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

    def bridged(self) -> tuple[str, ...]:
        """The coarse sorts whose constants stand in `component`: those that are refined."""
        symbols = (self.coarse.symbols[name] for name in self.counterparts)
        sorts = (sort.name for symbol in symbols for sort in symbol.sorts)
        return tuple(dict.fromkeys([*self.magnified, *filter(self.touches, sorts)]))


def vocabulary_of(fine: syntax.Source, coarse: Signature, problems: Problems) -> Vocabulary:
    """The names of both resolutions. Reports what is unknown, stated twice or missing."""
    into = {each.sort.name: each.into for each in fine.each(Magnification)}
    parts = {each.whole.name: tuple(p.name for p in each.parts) for each in fine.each(Components)}
    symbols = (each.symbol.name for each in fine.each(Counterpart))
    names = Vocabulary(
        coarse,
        magnified={sort: fine_sort for sort, fine_sort in into.items() if sort in coarse.sorts},
        components={c: parts.get(c, (c,)) for members in coarse.sorts.values() for c in members},
        counterparts={name: PREFIX + name for name in symbols if name in coarse.symbols},
    )
    for mistakes in (_of_magnified_sorts, _of_components, _of_counterparts, _of_other_names):
        problems.report_all(mistakes(fine, names))
    return names


def _of_magnified_sorts(fine: syntax.Source, names: Vocabulary) -> Mistakes:
    sorts, owners = names.coarse.sorts, dict[str, str]()
    taken = {*sorts, *names.coarse.symbols, COMPONENT, FINE, COARSE}
    listed = {statement.whole.name for statement in fine.each(Components)}
    for statement in fine.each(Magnification):
        name, place = statement.sort.name, statement.place
        members = sorts.get(name, ())
        twice = next((c for c in members if c in owners), None)
        if name not in sorts:
            yield statement.sort.place, f"unknown sort '{name}'; {suggestion(name, sorts)}"
        elif twice is not None:
            yield place, f"'{twice}' is magnified already, as one of '{owners[twice]}'"
        elif statement.into in taken:
            yield place, f"the name '{statement.into}' is taken; the fine sort is a new one"
        elif listed.isdisjoint(members):
            yield place, f"no constant of sort '{name}' has components"
        taken.add(statement.into)
        owners |= dict.fromkeys(members, name)


def _of_components(fine: syntax.Source, names: Vocabulary) -> Mistakes:
    """A constant of a magnified sort is listed once, with components that are nothing else's."""
    constants = names.coarse.constants
    magnifiable = {c for sort in names.magnified for c in names.coarse.sorts[sort]}
    lines, owners = dict[str, int](), dict[str, str]()
    for statement in fine.each(Components):
        whole, place = statement.whole.name, statement.place
        if whole not in constants:
            yield place, f"unknown constant '{whole}'; {suggestion(whole, magnifiable)}"
        elif whole not in magnifiable:
            yield place, f"'{whole}' is of no magnified sort, so that it has no components"
        elif whole in lines:
            yield place, f"the components of '{whole}' are listed in line {lines[whole]} already"
        else:
            lines[whole] = place.line
            if not statement.parts:
                yield place, f"'{whole}' has no components"
            for part in statement.parts:
                if part.name in owners:
                    first = f"first for '{owners[part.name]}'"
                    yield part.place, f"'{part.name}' is listed twice, {first}"
                elif part.name in constants:
                    yield part.place, f"the name '{part.name}' is one of the coarse constants"
                owners.setdefault(part.name, whole)


def _of_counterparts(fine: syntax.Source, names: Vocabulary) -> Mistakes:
    """A counterpart is about something magnified, and has a name of its own."""
    coarse, seen = names.coarse, set[str]()
    for statement in fine.each(Counterpart):
        name, place = statement.symbol.name, statement.place
        counterpart, symbol = PREFIX + name, coarse.symbols.get(name)
        if symbol is None:
            known = suggestion(name, coarse.symbols)
            yield place, f"unknown static, fluent or action '{name}'; {known}"
        elif name in seen:
            yield place, f"'{name}' is listed twice"
        elif counterpart in coarse.symbols or counterpart in coarse.sorts:
            yield place, f"the coarse description has a '{counterpart}'"
        elif not any(names.touches(sort.name) for sort in symbol.sorts):
            yield place, f"'{name}' has no argument of a magnified sort"
        seen.add(name)


def _of_other_names(fine: syntax.Source, names: Vocabulary) -> Mistakes:
    """Names that refined descriptions use are free; a fluent with a counterpart is not tested."""
    first = fine.statements[0].place if fine.statements else syntax.Place(1, 1)
    for name in (COMPONENT, FINE, COARSE):
        if name in names.coarse.sorts or name in names.coarse.symbols:
            yield first, f"the coarse description has a '{name}'; call it otherwise"
    for fluent in (statement.fluent for statement in fine.each(TestsStatement)):
        if fluent.name in names.counterparts:
            test = f"test '{names.counterparts[fluent.name]}'"
            message = f"'{fluent.name}' is observed by way of its components only; {test}"
            yield fluent.place, message
