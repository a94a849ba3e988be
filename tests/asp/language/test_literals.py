"""A literal is its text and its parts, made of either."""

import copy
import json
import pickle

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asp.language import Literal

NAMES = st.from_regex(r"_{0,2}[a-z][A-Za-z0-9_]{0,8}", fullmatch=True)
NUMBERS = st.integers(0, 10**9 - 1).map(str)
CONSTANTS = st.one_of(NAMES, NUMBERS)
PARTS = st.tuples(NAMES, st.lists(CONSTANTS, max_size=4).map(tuple), st.booleans())


def _text(name: str, arguments: tuple[str, ...], is_positive: bool) -> str:
    inside = "(" + ",".join(arguments) + ")" if arguments else ""
    return ("" if is_positive else "-") + name + inside


def _parts(literal: Literal) -> tuple[str, tuple[str, ...], bool]:
    return literal.name, literal.arguments, literal.is_positive


@given(PARTS)
def test_the_text_of_parts_has_these_parts(parts: tuple[str, tuple[str, ...], bool]) -> None:
    literal = Literal.parse(_text(*parts))
    assert _parts(literal) == parts
    assert literal == _text(*parts) == Literal.of(*parts)
    assert hash(literal) == hash(_text(*parts))
    assert str(literal) == literal
    assert type(str(literal)) is str
    assert Literal.parse(literal) is literal


@given(PARTS)
def test_the_complement_of_the_complement_is_the_literal(
    parts: tuple[str, tuple[str, ...], bool],
) -> None:
    literal = Literal.of(*parts)
    assert literal.complement != literal
    assert literal.complement.complement == literal
    assert literal.atom == literal.complement.atom == _text(*parts[:2], True)
    assert _parts(literal.complement) == (*parts[:2], not parts[2])


@given(PARTS, st.dictionaries(CONSTANTS, CONSTANTS))
def test_each_constant_is_renamed_and_nothing_else(
    parts: tuple[str, tuple[str, ...], bool], names: dict[str, str]
) -> None:
    names |= {each: f"other_{number}" for number, each in enumerate(parts[1])}
    renamed = Literal.of(*parts).renamed(names)
    assert _parts(renamed) == (parts[0], tuple(names[each] for each in parts[1]), parts[2])


@pytest.mark.parametrize("word", ["holds", "step", "wait", "not", "a"])
def test_a_name_like_a_constant_is_kept_where_the_constant_is_renamed(word: str) -> None:
    renamed = Literal.of(word, [word, f"{word}s", f"x_{word}"]).renamed({word: "other"})
    assert renamed == f"{word}(other,{word}s,x_{word})"


@given(PARTS)
def test_a_literal_travels_with_its_parts(parts: tuple[str, tuple[str, ...], bool]) -> None:
    literal = Literal.of(*parts)
    for copied in (pickle.loads(pickle.dumps(literal)), copy.deepcopy(literal)):
        assert isinstance(copied, Literal)
        assert copied == literal
        assert _parts(copied) == parts


@given(PARTS)
def test_what_is_written_is_the_text(parts: tuple[str, tuple[str, ...], bool]) -> None:
    literal = Literal.of(*parts)
    assert json.loads(json.dumps([literal])) == [_text(*parts)]
    for form in (msgspec.json, msgspec.msgpack):
        written = form.encode([literal], enc_hook=str)
        assert written == form.encode([_text(*parts)])
        (read,) = form.decode(written, type=list[Literal], dec_hook=lambda _, o: Literal.parse(o))
        assert _parts(read) == parts


@pytest.mark.parametrize(
    "text",
    [
        "",
        "-",
        "--f",
        "f()",
        "f(a",
        "f(a,)",
        "f(,a)",
        "f(a)b",
        "f( a)",
        "f(a, b)",
        "F",
        "f(X)",
        "f(g(a))",
        "3",
        "f(-a)",
        "f.",
        "f(a).",
        "not f",
        "f\n",
        "f(a)\n",
        "é",
        "f(é)",
        "_",
        "f(_)",
    ],
)
def test_what_is_no_ground_literal_is_refused(text: str) -> None:
    with pytest.raises(ValueError) as refused:  # noqa: PT011 - the text stands in the one line
        Literal.parse(text)
    assert repr(text) in str(refused.value)


def test_a_literal_does_not_change() -> None:
    literal = Literal.of("f", ["a"])
    with pytest.raises(AttributeError):
        literal.name = "g"  # type: ignore[misc]
    with pytest.raises(AttributeError):
        del literal.name
    assert literal.name == "f"


def test_literals_sort_and_compare_as_text() -> None:
    texts = ["-f(b)", "g", "f(b)", "f(a,c)", "f(a)", "-g", "f"]
    assert sorted(map(Literal.parse, texts)) == sorted(texts)
    assert {Literal.parse("f(a)"): 1}["f(a)"] == 1
    assert "f(a)" in {Literal.parse("f(a)")}
