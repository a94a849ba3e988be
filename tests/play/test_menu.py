"""A menu: what is typed chooses one of the choices, or none, and never anything else."""

from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from asp.language import Literal
from testbed.play.keys import BACKSPACE, DOWN, END, ENTER, HOME, PAGE_DOWN, PAGE_UP, UP
from testbed.play.menu import Choice, Menu, answered, chosen
from testbed.text import plain

NUMBERS = (0, 3, 4, 17, 30, 31, 170)
CHOICES = [Choice(number, Literal.parse(f"act(a{number})")) for number in NUMBERS]
KEYS = (UP, DOWN, PAGE_UP, PAGE_DOWN, HOME, END, ENTER, BACKSPACE, "0", "1", "3", "7", "x")


def _pressed(menu: Menu, keys: Sequence[str]) -> Choice | None:
    for key in keys:
        if (own := menu.press(key)) is not None:
            return own
    return None


@pytest.mark.parametrize("height", [1, 2, 50])
@pytest.mark.parametrize("at", range(len(CHOICES)))
def test_each_choice_is_reached_by_its_number_and_by_arrows(height: int, at: int) -> None:
    assert _pressed(Menu(CHOICES, height), [*str(NUMBERS[at]), ENTER]) is CHOICES[at]
    assert _pressed(Menu(CHOICES, height), [DOWN] * at + [ENTER]) is CHOICES[at]
    back = [END] + [UP] * (len(CHOICES) - 1 - at) + [ENTER]
    assert _pressed(Menu(CHOICES, height), back) is CHOICES[at]


def test_a_number_that_is_none_of_them_chooses_nothing_until_it_is_mended() -> None:
    menu = Menu(CHOICES, 5)
    assert _pressed(menu, ["3", "7", ENTER]) is None
    assert _pressed(menu, [BACKSPACE, ENTER]) is CHOICES[1]


@given(st.lists(st.sampled_from(KEYS), max_size=30), st.integers(1, 9), st.integers(1, 60))
def test_lines_fit_and_show_the_cursor(keys: list[str], height: int, width: int) -> None:
    menu = Menu(CHOICES, height)
    for key in keys:
        menu.press(key)
        lines = menu.lines(width)
        assert len(lines) == min(height, len(CHOICES)) + 1
        assert all(len(line) < max(2, width) for line in lines)
        assert sum(line.startswith(">") for line in lines[:-1]) == 1


@given(st.text(max_size=40))
def test_any_text_is_a_choice_or_is_answered(text: str) -> None:
    own = chosen(text, CHOICES)
    if own is None:
        lines = [*answered(text, CHOICES)]
        assert lines
        assert all(plain(line) == line for line in lines)
    else:
        wanted = "".join(text.split())
        assert wanted == own.action or int(wanted) == own.number


@pytest.mark.parametrize("own", CHOICES)
def test_an_action_chooses_itself_and_a_part_of_it_lists_it(own: Choice) -> None:
    assert chosen(f" {own.action}\n", CHOICES) is own
    part = own.action[:-1]
    assert chosen(part, CHOICES) is None
    assert own.line in [*answered(part, CHOICES)]
