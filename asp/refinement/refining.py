"""D_f as AL_d text, made of a coarse description and the text that refines it."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from asp.language import Problems, syntax, text_of
from asp.language import variable_sorts as roles
from asp.refinement.language import COARSE, COMPONENT, FINE, Vocabulary
from asp.refinement.laws import KEPT, LIFTED, REFINED, Rewriting

_LAWS = (syntax.CausalLaw, syntax.StateConstraint, syntax.ExecutabilityCondition)
_FURTHER: Mapping[str, type[syntax.Statement]] = {
    "initially": syntax.InitiallyStatement,
    "sees": syntax.SeesStatement,
    "shows": syntax.ShowsStatement,
}


def weak_text(
    coarse: syntax.Source, fine: syntax.Source, vocabulary: Vocabulary, problems: Problems
) -> str:
    """The weak refinement: the physics of the fine resolution, not yet what can be observed.

    Reports, with the place in the coarse text, each law that cannot be refined.
    """
    rewriting = Rewriting(vocabulary, coarse, shared_places(fine), problems)
    results = [
        (statement, manner, f"{text_of(statement)}  % line {law.place.line}: {text_of(law)}")
        for law in coarse.statements
        if isinstance(law, (*_LAWS, *_FURTHER.values()))
        for statement, manner in rewriting.refine(law)
    ]
    groups = {
        heading: [text for s, how, text in results if how == heading and isinstance(s, _LAWS)]
        for heading in (KEPT, REFINED, LIFTED)
    }
    groups["Bridge axioms: a coarse fluent holds where its counterpart holds of components."] = [
        f"{_bridge(name, vocabulary)}  % {name}"
        for name in vocabulary.counterparts
        if vocabulary.coarse.symbols[name].kind in roles.FLUENTS
    ]
    groups["Particular to the fine resolution."] = [
        f"{text_of(law)}  % {fine.file}, line {law.place.line}"
        for law in fine.statements
        if isinstance(law, _LAWS)
    ]
    statements = [*(statement for statement, _, _ in results), *fine.statements]
    sections = [
        f"% The refinement of {coarse.file} by {fine.file}. Lines are those of {coarse.file}.",
        *_declarations(coarse, vocabulary, statements),
        law_section(groups),
        _facts(coarse, fine, vocabulary),
        *(
            section(title, (text for s, _, text in results if isinstance(s, kind)))
            for title, kind in _FURTHER.items()
        ),
    ]
    return "\n\n".join(filter(None, sections)) + "\n"


def shared_places(fine: syntax.Source) -> frozenset[tuple[str, int]]:
    """The arguments in which all components of one whole share a fluent, by a law of the text.

    `fine_loc(P1, C) if fine_loc(P2, C), component(P1, O), component(P2, O)`: ("fine_loc", 0).
    """
    found = (_shared_place(law) for law in fine.each(syntax.StateConstraint))
    return frozenset(place for place in found if place is not None)


def _shared_place(law: syntax.StateConstraint) -> tuple[str, int] | None:
    head, body = law.head.atom, list(roles.literals(law.body))
    same = [part.atom for part in body if part.atom.name == head.name and part.positive]
    wholes = {p.atom.args[0].name: p.atom.args[1].name for p in body if p.atom.name == COMPONENT}
    if len(same) != 1 or len(wholes) != 2 or len(body) != 3 or not law.head.positive:
        return None
    pairs = enumerate(zip(head.args, same[0].args, strict=True))
    differ = [(place, {a.name, b.name}) for place, (a, b) in pairs if a.name != b.name]
    if len(differ) != 1 or differ[0][1] != set(wholes) or len(set(wholes.values())) != 1:
        return None
    compared = ({c.left.name, c.right.name} for c in roles.comparisons(law.body))
    return (head.name, differ[0][0]) if all(names == set(wholes) for names in compared) else None


def law_section(groups: Mapping[str, Iterable[str]]) -> str:
    """The section of laws, each group under its heading; nothing where there are no laws."""
    texts = {heading: "\n".join(f"  {law}" for law in laws) for heading, laws in groups.items()}
    filled = "\n\n".join(f"  % {heading}\n{text}" for heading, text in texts.items() if text)
    return f"laws\n{filled}" if filled else ""


def _bridge(name: str, vocabulary: Vocabulary) -> str:
    """A bridge axiom, (15)."""
    sorts = enumerate(vocabulary.coarse.symbols[name].sorts, start=1)
    refined = {place: vocabulary.touches(sort.name) for place, sort in sorts}
    wholes = ", ".join(f"X{place}" for place in refined)
    parts = ", ".join(f"{'Y' if finer else 'X'}{place}" for place, finer in refined.items())
    links = [f"{COMPONENT}(Y{place}, X{place})" for place, finer in refined.items() if finer]
    body = ", ".join([*links, f"{vocabulary.counterparts[name]}({parts})"])
    return f"{name}({wholes}) if {body}."


def _facts(coarse: syntax.Source, fine: syntax.Source, vocabulary: Vocabulary) -> str:
    sorts = vocabulary.coarse.sorts
    wholes = dict.fromkeys(whole for sort in vocabulary.bridged() for whole in sorts[sort])
    pairs = ((part, whole) for whole in wholes for part in vocabulary.components[whole])
    components = (f"{COMPONENT}({part}, {whole})." for part, whole in pairs)
    stated = (text_of(fact) for text in (coarse, fine) for fact in text.each(syntax.Fact))
    return section("facts", [*stated, *components])


def _declarations(
    coarse: syntax.Source, vocabulary: Vocabulary, statements: Iterable[syntax.Statement]
) -> Iterator[str]:
    """The sections that declare what the statements, refined and particular, are about."""
    named = {use.atom.name for statement in statements for use in roles.uses(statement)}
    yield section("sorts", _sorts(coarse, vocabulary, named))
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
    fine_sort, name = vocabulary.fine_sort, vocabulary.counterparts[declaration.name]
    sorts = tuple(replace(sort, name=fine_sort(sort.name)) for sort in declaration.sorts)
    return replace(declaration, name=name, sorts=sorts)


def _sorts(coarse: syntax.Source, vocabulary: Vocabulary, named: set[str]) -> Iterator[str]:
    definitions = {d.name: d for d in coarse.each(syntax.SortDefinition)}
    wanted = _wanted(definitions, vocabulary, named)
    for name, definition in definitions.items():
        yield text_of(definition)
        if name in vocabulary.magnified:
            members = _components(vocabulary.coarse.sorts[name], vocabulary)
            yield f"{vocabulary.magnified[name]} = {members}."
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
    return " + ".join(
        vocabulary.fine_sort(part.name)
        if isinstance(part, syntax.Term)
        else _components((whole.name for whole in part), vocabulary)
        for part in definition.parts
    )


def _components(wholes: Iterable[str], vocabulary: Vocabulary) -> str:
    """The set of the components of these constants."""
    found = dict.fromkeys(part for whole in wholes for part in vocabulary.components[whole])
    return f"{{{', '.join(found)}}}"


def section(title: str, lines: Iterable[str]) -> str:
    """A section of AL_d; nothing where there are no lines."""
    body = "\n".join(f"  {line}" for line in lines)
    return f"{title}\n{body}" if body else ""
