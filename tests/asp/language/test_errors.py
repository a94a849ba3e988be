"""Every mistake in an AL_d text is told with its place and with what would be right."""

import pytest

from asp import SourceError, load_description, parse_description
from tests.asp.language.mistakes_of_form import CYCLES, FORMS, SYNTAX
from tests.asp.language.mistakes_of_names import ARGUMENTS, NAMES

# The mistakes below are in the lines behind these; the first of them is line 16.
HOUSE = """\
sorts
  room  = {hall, attic}.
  thing = {book, lamp}.
statics
  next_to(room, room).
  far(room, room).
fluents
  inertial loc(thing, room).
  inertial lit.
  inertial warm.
  defined  seen(thing).
actions
  agent     carry(thing, room).
  exogenous blow.
laws
"""

MISTAKES = {**SYNTAX, **NAMES, **ARGUMENTS, **FORMS, **CYCLES}


def mistakes_in(text: str) -> tuple[SourceError, ...]:
    with pytest.raises(SourceError) as caught:
        parse_description(HOUSE + text, "house.al")
    assert caught.value is caught.value.all[0]
    return tuple(caught.value.all)


def test_the_text_before_the_mistakes_is_right() -> None:
    assert HOUSE.count("\n") == 15
    parse_description(HOUSE, "house.al")


@pytest.mark.parametrize(("text", "place", "message"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_told_with_its_place(text: str, place: str, message: str) -> None:
    first = mistakes_in(text)[0]
    assert str(first).startswith(f"house.al:{place}: ")
    assert message in first.message
    assert f"{first.line}:{first.column}" == place
    assert first.file == "house.al"


@pytest.mark.parametrize("text", [text for text, *_ in (NAMES | ARGUMENTS | FORMS).values()])
def test_one_mistake_is_told_once(text: str) -> None:
    assert len(mistakes_in(text)) == 1


FOLLOWING = """\
  lies(T, L)     if loc(T, L), lies(T, L).
  carry(T, L)    causes lies(T, L).
  lift(T)        causes -lies(T, hall).
  impossible lift(T) if -lies(T, L), next_to(L, L).
sees
  lamp sees lies(T, L) if lit.
"""


@pytest.mark.parametrize("declared", ["holds", "loc"])
def test_a_declaration_that_failed_is_told_alone(declared: str) -> None:
    house = HOUSE.replace("inertial lit.", f"inertial lit.\n  inertial {declared}(thing, room).")
    house = house.replace("agent     carry", "agent  start(thing).\n  agent  carry")
    with pytest.raises(SourceError) as caught:
        parse_description(house + FOLLOWING)
    assert [(e.line, e.column) for e in caught.value.all] == [(10, 3), (14, 3)]
    with pytest.raises(SourceError) as caught:
        parse_description(house + "lid if warm.\n")  # no such declaration can have been meant
    assert [e.line for e in caught.value.all] == [10, 14, 18]


@pytest.mark.parametrize("text", [text for text, *_ in MISTAKES.values()], ids=MISTAKES)
def test_a_message_has_no_name_of_the_parsers_own(text: str) -> None:
    assert "__" not in mistakes_in(text)[0].message.lower()


RIGHT = {
    "a cycle without negation": "lit if warm.\nwarm if lit.",
    "negative heads that exclude each other": "-lit if warm.\n-warm if lit.",
    "negation of what is defined elsewhere": "lit if -warm.\nseen(T) if -lit.",
    "instances that close no cycle": "loc(T, hall) if -loc(T, attic).",
    "a static that is not another": "far(L1, L2) if -next_to(L1, L2).",
    "a constant of two sorts": "sorts\n  own = thing + {ring}.\n  old = {book}.",
}


@pytest.mark.parametrize("text", RIGHT.values(), ids=RIGHT)
def test_what_is_no_mistake_is_let_through(text: str) -> None:
    parse_description(HOUSE + text, "house.al")


def test_all_mistakes_of_a_text_are_told_in_the_order_of_the_source() -> None:
    text = "lid if worm.\nfluents\n  inertial at(rom).\nlaws\ncary(T, L) causes lit.\n"
    places = [f"{error.line}:{error.column}" for error in mistakes_in(text)]
    assert places == ["16:1", "16:8", "18:15", "20:1"]


def test_the_cycles_of_a_text_are_all_told() -> None:
    lines = [
        error.line for error in mistakes_in("lit if -warm.\nwarm if -lit.\nseen(T) if -seen(T).")
    ]
    assert lines == [16, 17, 18]


def test_an_unknown_domain_is_told_with_the_known_ones() -> None:
    with pytest.raises(FileNotFoundError, match=r"offce: no such domain.*office"):
        load_description("offce")


USES_OF_A_FAULTY_DECLARATION = {
    "in laws": "laws\n  blow causes -shut(R) if shut(R).\n  impossible blow if -shut(R).",
    "in a default": "defaults\n  d: shut(R) if shut(Q).\n  exception d if lit, R != hall.",
    "where it is seen and shown": "sees\n  R sees shut(R).\nshows\n  carry(T, R) shows shut(R).",
    "at first and when an event fires": (
        "initially\n  shut(R) for some R.\nscenarios\n  2: blow upon any drawing R with shut(R)."
    ),
}


@pytest.mark.parametrize("uses", USES_OF_A_FAULTY_DECLARATION.values())
def test_a_misspelt_sort_is_told_once_however_its_fluent_is_used(uses: str) -> None:
    text = f"fluents\n  inertial shut(rom).\n{uses}\n"
    found = [str(mistake) for mistake in mistakes_in(text)]
    assert found == ["house.al:17:17: unknown sort 'rom'; did you mean 'room'?"]
