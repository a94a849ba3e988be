"""What is said of a word that is not known."""

import pytest

from asp.language import suggestion


@pytest.mark.parametrize(
    ("word", "known", "said"),
    [
        ("libary", ["kitchen", "library"], "did you mean 'library'?"),
        ("attic", ["library", "kitchen", "kitchen"], "known: kitchen, library"),
        ("attic", [], "none is known here"),
    ],
)
def test_a_suggestion_is_the_nearest_word_or_all_of_them(
    word: str, known: list[str], said: str
) -> None:
    assert suggestion(word, known) == said


def test_nothing_is_near_where_nothing_is_alike() -> None:
    assert "seed" in suggestion("sed", ["seed", "name"])
    assert "mean" not in suggestion("sed", ["name"])
