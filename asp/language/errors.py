"""Mistakes in an action description, each with its place and a correction."""

from collections.abc import Iterable, Sequence, Set
from difflib import get_close_matches

from lark import Lark, ParseTree, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken
from lark.lexer import PatternStr
from lark.tree import Meta

from asp.language import syntax

_SECTION = 9
"""The priority of section words in grammars: above all others."""
_READABLE = {
    "NAME": "a name",
    "SCENARIO": "a name",
    "VARIABLE": "a variable",
    "NUMBER": "a number",
    "DECIMAL": "a number",
    "DOT": "a full stop",
}
_ALONE = "the section word '{}' stands alone on its line"
_LIKENESS = 0.5


class SourceError(ValueError):
    """One mistake in an AL_d text, with its place.

    `str()` gives `file:line:column: message`. When several mistakes were found in one text, the
    first is raised and `all` holds every one of them in the order of the source.
    """

    def __init__(self, file: str, place: syntax.Place, message: str) -> None:
        super().__init__(f"{file}:{place.line}:{place.column}: {message}")
        self.file, self.line, self.column = file, place.line, place.column
        self.message = message
        self.all: Sequence[SourceError] = (self,)


class DomainError(ValueError):
    """Something asked of a domain that it does not have, or a state that it cannot be in.

    `message` is one line; `key` is where that stands in what was asked, as `("history", 2)`.
    """

    def __init__(self, message: str, *key: str | int) -> None:
        super().__init__(": ".join(filter(None, [".".join(map(str, key)), message])))
        self.message, self.key = message, key


class Problems(list[SourceError]):
    """The mistakes found so far in one text.

    `failed` are the declarations whose names cannot be what they were meant to be: what uses
    the names that were meant is right.
    """

    def __init__(self, file: str) -> None:
        super().__init__()
        self.file = file
        self.failed: list[syntax.Declaration] = []

    def report(self, place: syntax.Place, message: str) -> None:
        self.append(SourceError(self.file, place, message))

    def report_all(self, mistakes: Iterable[tuple[syntax.Place, str]]) -> None:
        for place, message in mistakes:
            self.report(place, message)

    def raise_first(self) -> None:
        """Raises the first mistake in the order of the source, which then knows all of them."""
        if self:
            ordered = sorted(self, key=lambda error: (error.line, error.column))
            ordered[0].all = tuple(ordered)
            raise ordered[0]


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word that is most like one, if any is like it at all."""
    return next(iter(get_close_matches(word, sorted(set(known)), n=1, cutoff=_LIKENESS)), None)


def suggestion(word: str, known: Iterable[str], otherwise: str | None = None) -> str:
    """The end of a line about an unknown word: the nearest known one, else all that are known.

    With `otherwise` that text stands in place of all that are known.
    """
    choices = sorted(set(known))
    near = nearest(word, choices)
    if near is not None:
        return f"did you mean '{near}'?"
    if otherwise is not None:
        return otherwise
    return "known: " + ", ".join(choices) if choices else "none is known here"


def place_of(node: Meta | Token) -> syntax.Place:
    """Where a node of the parse tree begins."""
    assert node.line is not None
    assert node.column is not None
    return syntax.Place(node.line, node.column)


def syntax_error(error: UnexpectedInput, text: str, file: str, grammar: Lark) -> SourceError:
    """What lark found, with its place, in the words of the language."""
    sections = {t.name.lower() for t in grammar.terminals if t.priority == _SECTION}
    for token in _last(error):
        meant = _meant_section(token, text, sections)
        if meant is not None:
            message = f"unknown section '{token}'; did you mean '{meant}'?"
            return SourceError(file, place_of(token), message)
    place = syntax.Place(error.line, error.column)
    if isinstance(error, UnexpectedCharacters):
        return SourceError(file, place, f"unexpected character {error.char!r}")
    assert isinstance(error, UnexpectedToken)
    if error.token.type == "$END":
        lines = text.rstrip().split("\n")
        place = syntax.Place(len(lines), len(lines[-1]) + 1)
        return SourceError(file, place, "the text ends inside a statement")
    for token in _last(error):
        is_section = token.line == error.line and token.lower() in sections
        if is_section and _is_first_in_line(token, text):
            return SourceError(file, place, _ALONE.format(token))
    expected = _described(set(error.accepts or error.expected), grammar, sections)
    return SourceError(file, place, f"unexpected {str(error.token)!r}; expected {expected}")


def check_section_words(tree: ParseTree, text: str, file: str) -> None:
    """Raises SourceError for a section word behind something else on its line."""
    for section in tree.children:
        word = section.children[0] if isinstance(section, Tree) else section
        if isinstance(word, Token) and not _is_first_in_line(word, text):
            raise SourceError(file, place_of(word), _ALONE.format(word))


def _last(error: UnexpectedInput) -> list[Token]:
    """The unexpected token, if it is one, and the one before it, if there is one."""
    unexpected: list[Token] = []
    history: Sequence[object] = getattr(error, "token_history", None) or ()
    if isinstance(error, UnexpectedToken):
        unexpected = [error.token]
        if error.token.type == "$END":
            history = error.interactive_parser.parser_state.value_stack[-1:]
    return [*unexpected, *(token for token in history if isinstance(token, Token))]


def _meant_section(token: Token, text: str, sections: Set[str]) -> str | None:
    """The section word nearest to one alone on its line, where a statement or section begins."""
    line = place_of(token).line
    lines = [part.partition("%")[0] for part in text.split("\n")]
    before = " ".join(lines[: line - 1]).split()
    begins = not before or before[-1].endswith(".") or before[-1].lower() in sections
    if token.type not in ("NAME", "SCENARIO") or not begins or lines[line - 1].strip() != token:
        return None
    return nearest(token, sections)


def _is_first_in_line(token: Token, text: str) -> bool:
    return not text[: token.start_pos].rpartition("\n")[2].strip()


def _described(expected: Set[str], grammar: Lark, sections: Set[str]) -> str:
    words = {name for name in expected if name.lower() in sections}
    found = []
    if len(words) == len(sections):
        found.append(f"a section word such as {' or '.join(sorted(sections)[:2])}")
        expected -= words
    texts = {
        t.name: repr(t.pattern.value if isinstance(t.pattern, PatternStr) else t.name.lower())
        for t in grammar.terminals
    }
    found += sorted((texts | _READABLE)[name] for name in expected - {"$END"})
    return " or ".join(dict.fromkeys(found))
