"""Sorts, statics, fluents and actions of the refined description, as sections of AL_d text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from asp.language import syntax, text_of
from asp.language import variable_sorts as roles
from asp.refinement.vocabulary import COARSE, COMPONENT, FINE, Vocabulary


def declarations(
    coarse: syntax.Source,
    vocabulary: Vocabulary,
    statements: Iterable[syntax.Statement],
    fine: syntax.Source,
) -> Iterator[str]:
    """The sections that declare what the refined statements and the text's own laws are about."""
    yield section("sorts", _sorts(coarse, vocabulary, _named_sorts(statements, fine)))
    declared = list(coarse.each(syntax.Declaration))
    statics = [d for d in declared if d.kind == "static"]
    fluents = [d for d in declared if d.kind in roles.FLUENTS]
    actions = [d for d in declared if d.kind in roles.ACTIONS]
    bridged = [replace(d, kind="defined") for d in fluents if d.name in vocabulary.counterparts]
    finer = [_counterpart(d, vocabulary) for d in statics if d.name in vocabulary.counterparts]
    component = f"{COMPONENT}({FINE}, {COARSE})."
    yield section("statics", [*map(text_of, (*statics, *finer)), component])
    here = [*(_counterpart(d, vocabulary) for d in fluents), *bridged]
    yield section("fluents", map(text_of, here))
    yield section("actions", (text_of(_counterpart(d, vocabulary)) for d in actions))


def _counterpart(declaration: syntax.Declaration, vocabulary: Vocabulary) -> syntax.Declaration:
    """The declaration of a symbol's counterpart; the declaration itself where there is none."""
    if declaration.name not in vocabulary.counterparts:
        return declaration
    sorts = vocabulary.fine_sorts(declaration.name)
    return replace(
        declaration,
        name=vocabulary.counterparts[declaration.name],
        sorts=tuple(
            replace(sort, name=fine) for sort, fine in zip(declaration.sorts, sorts, strict=True)
        ),
    )


def _named_sorts(statements: Iterable[syntax.Statement], fine: syntax.Source) -> set[str]:
    """The names that stand as sorts, or as anything else, in laws."""
    return {use.atom.name for law in (*statements, *fine.statements) for use in roles.uses(law)}


def _sorts(coarse: syntax.Source, vocabulary: Vocabulary, named: set[str]) -> Iterator[str]:
    definitions = {d.name: d for d in coarse.each(syntax.SortDefinition)}
    wanted = _wanted(definitions, vocabulary, named)
    for name, definition in definitions.items():
        yield text_of(definition)
        if name in vocabulary.magnified:
            yield f"{vocabulary.magnified[name]} = {{{', '.join(vocabulary.fine_members(name))}}}."
        elif name in wanted:
            yield f"{vocabulary.fine_sort(name)} = {_fine_parts(definition, vocabulary)}."
    bridged = vocabulary.bridged()
    yield f"{FINE} = {' + '.join(map(vocabulary.fine_sort, bridged))}."
    yield f"{COARSE} = {' + '.join(bridged)}."


def _wanted(
    definitions: Mapping[str, syntax.SortDefinition], vocabulary: Vocabulary, named: set[str]
) -> set[str]:
    """The coarse sorts, mixed or parts of magnified ones, whose fine counterparts are used."""
    stack = [*vocabulary.bridged()]
    stack += (name for name in definitions if vocabulary.fine_sort(name) in named)
    found: set[str] = set()
    while stack:
        name = stack.pop()
        if name not in found and name not in vocabulary.magnified and vocabulary.touches(name):
            found.add(name)
            parts = definitions[name].parts
            stack += (part.name for part in parts if isinstance(part, syntax.Term))
    return found


def _fine_parts(definition: syntax.SortDefinition, vocabulary: Vocabulary) -> str:
    parts = []
    for part in definition.parts:
        if isinstance(part, syntax.Term):
            parts.append(vocabulary.fine_sort(part.name))
        else:
            members = (fine for whole in part for fine in vocabulary.components[whole.name])
            parts.append("{" + ", ".join(dict.fromkeys(members)) + "}")
    return " + ".join(parts)


def section(title: str, lines: Iterable[str]) -> str:
    """A section of AL_d; nothing where there are no lines."""
    body = "\n".join(f"  {line}" for line in lines)
    return f"{title}\n{body}" if body else ""
