"""Reading a description: text or file in, checked ground description out."""

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from importlib.resources import files
from math import prod
from pathlib import Path

from asp.language import syntax
from asp.language.checker import check, check_cycles
from asp.language.description import Description
from asp.language.errors import Problems, SourceError
from asp.language.grounding import ground_description
from asp.language.parser import parse
from asp.language.signature import Signature, signature_of
from asp.language.variable_sorts import variable_domains

MOST_TEXTS = 32
"""Of how many texts the description is remembered: those that were read last."""


@lru_cache(maxsize=MOST_TEXTS)
def analyse(text: str, file: str = "<text>") -> tuple[syntax.Source, Signature]:
    """Parses and checks a text, each of the last few once.

    Raises SourceError, whose `all` holds every mistake found.
    """
    source = parse(text, file)
    problems = Problems(file)
    signature = signature_of(source, problems)
    check(source, signature, problems)
    problems.raise_first()
    check_sizes(source, signature, problems)
    problems.raise_first()
    check_cycles(source, signature, problems)
    problems.raise_first()
    return source, signature


@lru_cache(maxsize=MOST_TEXTS)
def parse_description(text: str, file: str = "<text>") -> Description:
    """The ground description of an AL_d text. Raises SourceError."""
    source, signature = analyse(text, file)
    return ground_description(source, signature, Path(file).stem)


def load_description(name_or_path: str) -> Description:
    """The description of a file, or of a packaged domain by its bare name (`office`).

    Raises SourceError for a mistake in the text and FileNotFoundError, whose text names the
    packaged domains, where there is no such file.
    """
    file, text = read_domain(name_or_path)
    return parse_description(text, file)


def read_domain(name_or_path: str) -> tuple[str, str]:
    """The file name, for errors, and the text of a domain. Raises FileNotFoundError."""
    wanted = "domain; give the path of an .al file"
    return read_packaged(name_or_path, f"{name_or_path}.al", wanted, packaged_domains())


def read_packaged(given: str, packaged: str, wanted: str, known: Iterable[str]) -> tuple[str, str]:
    """The name and the text of a file in `asp/domains`, or of another by its path.

    Raises FileNotFoundError, whose text says what is wanted and which packaged ones are known.
    """
    entry = files("asp").joinpath("domains", packaged)
    if "/" not in given and entry.is_file():
        return packaged, entry.read_text(encoding="utf-8")
    path = Path(given)
    if not path.is_file():  # nor can it be where the name has a character that none of a file has
        raise FileNotFoundError(f"{given}: no such {wanted} or one of {', '.join(known)}")
    return str(path), read_text(path)


def read_text(path: Path) -> str:
    """The text of a file. Raises SourceError, at its place, for what is not UTF-8, and OSError."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        before = error.object[: error.start]
        place = syntax.Place(before.count(b"\n") + 1, error.start - before.rfind(b"\n"))
        message = f"not a text file in UTF-8: {error.reason}"
        raise SourceError(str(path), place, message) from None


def packaged_domains(ending: str = ".al") -> tuple[str, ...]:
    """The names, without their ending, of the domains that come with this package."""
    names = (entry.name for entry in files("asp").joinpath("domains").iterdir())
    return tuple(sorted(n.removesuffix(ending) for n in names if n.endswith(ending)))


MOST_SYMBOLS = 500_000
"""Ground fluents and actions of a description."""
MOST_INSTANCES = 5_000_000
"""Instances of all statements of a description, those included that their bodies rule out."""


def check_sizes(source: syntax.Source, signature: Signature, problems: Problems) -> None:
    """Reports what has most instances where there are too many of them."""
    symbols: dict[syntax.Statement, int] = {
        own: prod(len(signature.sorts[sort.name]) for sort in own.sorts)
        for own in signature.symbols.values()
        if own.kind != "static"
    }
    statements = {
        own: prod(map(len, variable_domains(own, signature).values())) for own in source.statements
    }
    for sizes, most, whose in (
        (symbols, MOST_SYMBOLS, "all fluents and actions together"),
        (statements, MOST_INSTANCES, "all statements together"),
    ):
        if sum(sizes.values()) > most:
            largest = max(sizes, key=sizes.__getitem__)
            message = f"has {sizes[largest]} instances; {most} are the most for {whose}"
            problems.report(largest.place, f"{message}: smaller sorts")


@lru_cache(maxsize=MOST_TEXTS)
def check_one_robot(text: str, file: str) -> None:
    """Check that the actions of a description are those of one robot.

    The robot is the first constant that sees something. A second one is a constant that can take
    its place in each action; or one that sees, too, and has actions, but no part in the first's.

    Raises:
        SourceError: at the sort that has the second robot; or for a mistake in the text.
    """
    seers = parse_description(text, file).robots
    source, signature = analyse(text, file)
    second = next(_second(seers, signature), None)
    if second is not None:
        place = next(
            definition.place
            for definition in source.each(syntax.SortDefinition)
            for part in definition.parts
            if isinstance(part, tuple) and second in (constant.name for constant in part)
        )
        message = f"{seers[0]} and {second} are two robots, and a description has one for now; "
        message += f"drop {second}, or give what is no robot a sort of its own"
        raise SourceError(file, place, message)


def _second(seers: Sequence[str], signature: Signature) -> Iterator[str]:
    actions = [
        [set(signature.sorts[sort.name]) for sort in symbol.sorts]
        for symbol in signature.of_kind("agent")
    ]
    for robot in seers[:1]:
        own = [places for places in actions if any(robot in members for members in places)]
        if own and len(own) == len(actions):
            alike = (set().union(*(m for m in places if robot in m)) for places in own)
            yield from sorted(set.intersection(*alike) - {robot})
        acted_upon, acting = (
            {constant for places in some for members in places for constant in members}
            for some in (own, actions)
        )
        yield from (seer for seer in seers[1:] if own and seer in acting - acted_upon)
