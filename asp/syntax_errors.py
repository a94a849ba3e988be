"""What is said about a text that does not follow the grammar."""

from __future__ import annotations

from lark import ParseTree, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedEOF, UnexpectedInput, UnexpectedToken

from asp.errors import SourceError

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
}
_SECTIONS = {
    *("SORTS", "STATICS", "FLUENTS", "ACTIONS", "LAWS", "FACTS"),
    *("SEES", "SHOWS", "COSTS", "INITIALLY", "DEFAULTS", "SCENARIOS"),
}


def syntax_error(error: UnexpectedInput, text: str, file: str) -> SourceError:
    """What lark found, with its place, in the words of the language."""
    if isinstance(error, UnexpectedCharacters):
        return SourceError(file, error.line, error.column, f"unexpected character {error.char!r}")
    if isinstance(error, UnexpectedEOF) or _at_end(error):
        lines = text.rstrip().split("\n")
        return SourceError(file, len(lines), len(lines[-1]) + 1, "the text ends inside a statement")
    assert isinstance(error, UnexpectedToken)
    for token in _on_one_line(error):
        if token.upper() in _SECTIONS and _is_first_in_line(token, text):
            return SourceError(file, error.line, error.column, _alone(token))
    expected = _describe(set(error.accepts or error.expected))
    message = f"unexpected {str(error.token)!r}; expected {expected}"
    return SourceError(file, error.line, error.column, message)


def _at_end(error: UnexpectedInput) -> bool:
    return isinstance(error, UnexpectedToken) and error.token.type == "$END"


def _on_one_line(error: UnexpectedToken) -> list[Token]:
    """The unexpected token, and the one before it if it stands on the same line."""
    before = [token for token in error.token_history or () if token is not None]
    return [error.token, *(token for token in before if token.line == error.token.line)]


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


def _describe(expected: set[str]) -> str:
    if expected.issuperset(_SECTIONS):
        expected = expected.difference(_SECTIONS)
        words = ["a section word such as sorts or laws"]
    else:
        words = []
    words += sorted(_READABLE.get(name, repr(name.lower())) for name in expected - {"$END"})
    return " or ".join(dict.fromkeys(words))
