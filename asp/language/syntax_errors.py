"""What is said about a text that does not follow the grammar."""

from __future__ import annotations

from dataclasses import dataclass

from lark import ParseTree, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedEOF, UnexpectedInput, UnexpectedToken

from asp.language.errors import SourceError, nearest

_READABLE = {
    "NAME": "a name",
    "VARIABLE": "a variable",
    "NUMBER": "a number",
    "DECIMAL": "a number",
    "DOT": "a full stop",
    "LPAR": "'('",
    "RPAR": "')'",
    "COMMA": "','",
    "EQUAL": "'='",
    "UNEQUAL": "'!='",
    "MINUS": "'-'",
    "PLUS": "'+'",
    "LBRACE": "'{'",
    "RBRACE": "'}'",
    "COLON": "':'",
    "_TO": "'..'",
}


@dataclass(frozen=True)
class Words:
    """The names of a grammar's section words, and two of them to give as examples."""

    names: frozenset[str]
    examples: str


AL_WORDS = Words(
    frozenset(
        {
            *("SORTS", "STATICS", "FLUENTS", "ACTIONS", "LAWS", "FACTS"),
            *("SEES", "SHOWS", "COSTS", "INITIALLY", "DEFAULTS", "SCENARIOS"),
        }
    ),
    "sorts or laws",
)


def syntax_error(
    error: UnexpectedInput, text: str, file: str, words: Words = AL_WORDS
) -> SourceError:
    """What lark found, with its place, in the words of the language."""
    for token in _last(error):
        section = _meant_section(token, text, words)
        if section is not None:
            message = f"unknown section '{token}'; did you mean '{section}'?"
            return SourceError(file, *_place(token), message)
    if isinstance(error, UnexpectedCharacters):
        return SourceError(file, error.line, error.column, f"unexpected character {error.char!r}")
    if isinstance(error, UnexpectedEOF) or _at_end(error):
        lines = text.rstrip().split("\n")
        return SourceError(file, len(lines), len(lines[-1]) + 1, "the text ends inside a statement")
    assert isinstance(error, UnexpectedToken)
    for token in _on_one_line(error):
        if token.upper() in words.names and _is_first_in_line(token, text):
            return SourceError(file, error.line, error.column, _alone(token))
    expected = _describe(set(error.accepts or error.expected), words)
    message = f"unexpected {str(error.token)!r}; expected {expected}"
    return SourceError(file, error.line, error.column, message)


def _at_end(error: UnexpectedInput) -> bool:
    return isinstance(error, UnexpectedToken) and error.token.type == "$END"


def _on_one_line(error: UnexpectedToken) -> list[Token]:
    """The unexpected token, and the one before it if it stands on the same line."""
    return [token for token in _last(error) if token.line == error.token.line]


def _last(error: UnexpectedInput) -> list[Token]:
    """The unexpected token, if it is one, and the one before it, if there is one."""
    unexpected = [error.token] if isinstance(error, UnexpectedToken) else []
    history = getattr(error, "token_history", None) or ()
    if _at_end(error):
        assert isinstance(error, UnexpectedToken)
        history = error.interactive_parser.parser_state.value_stack[-1:]
    return [*unexpected, *(token for token in history if isinstance(token, Token))]


def _meant_section(token: Token, text: str, words: Words) -> str | None:
    """The section word nearest to one alone on its line, where a statement or section begins."""
    if token.type != "NAME":
        return None
    line, _ = _place(token)
    lines = [_without_comment(part) for part in text.split("\n")]
    before = " ".join(lines[: line - 1]).split()
    begins = not before or before[-1].endswith(".") or before[-1].upper() in words.names
    if not begins or lines[line - 1].strip() != token:
        return None
    return nearest(token, map(str.lower, words.names))


def _without_comment(line: str) -> str:
    return line.partition("%")[0]


def _is_first_in_line(token: Token, text: str) -> bool:
    line, column = _place(token)
    return not text.split("\n")[line - 1][: column - 1].strip()


def _place(token: Token) -> tuple[int, int]:
    assert token.line is not None
    assert token.column is not None
    return token.line, token.column


def _alone(token: Token) -> str:
    return f"the section word '{token}' stands alone on its line"


def check_section_words(tree: ParseTree, text: str, file: str) -> None:
    """Raises SourceError for a section word behind something else on its line."""
    for section in tree.children:
        assert isinstance(section, Tree)
        word = section.children[0]
        assert isinstance(word, Token)
        if not _is_first_in_line(word, text):
            raise SourceError(file, *_place(word), _alone(word))


def _describe(expected: set[str], words: Words) -> str:
    found = []
    if expected.issuperset(words.names):
        expected = expected.difference(words.names)
        found.append(f"a section word such as {words.examples}")
    found += sorted(
        _READABLE.get(name, repr(name.lower().strip("_"))) for name in expected - {"$END"}
    )
    return " or ".join(dict.fromkeys(found))
