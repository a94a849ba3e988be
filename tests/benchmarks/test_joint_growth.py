"""The comparison of TI with ATI, at its smallest size."""

from pathlib import Path

import pytest

from asp.reasoning import goal_facts
from asp.solving import answer_sets, fact, ground, theory
from benchmarks import joint_growth
from benchmarks.joint_growth import SIDES, draw, measure
from benchmarks.vanished import Vanished
from tests.benchmarks.late import takes_too_long


@pytest.mark.usefixtures("own_heap")
def test_all_sides_answer_every_question_and_are_drawn(tmp_path: Path) -> None:
    sheets = measure((3, 4), (3,), (1,))
    assert [sheet.name for sheet in sheets] == ["history", "rooms", "plan"]
    assert [row["steps"] for row in sheets[0].rows] == [3, 4]
    assert [row["rooms"] for row in sheets[1].rows] == [3]
    assert [row["actions"] for row in sheets[2].rows] == [4]
    rows = [row for sheet in sheets for row in sheet.rows]
    assert all(isinstance(row[f"{side}_ms"], float) for row in rows for side in SIDES)
    scratch = [side for side in SIDES if side != "kept"]
    assert all(isinstance(row[f"{side}_conflicts"], int) for row in rows for side in scratch)
    draw(sheets, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")


def test_a_side_that_takes_too_long_is_asked_no_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(joint_growth, "within", takes_too_long)
    history, *_ = measure((3, 4), (3,), (1,), limit_s=0.1)
    for side in SIDES:
        first, second = (row[f"{side}_ms"] for row in history.rows)
        assert (first, second) == ("> 0 s", None)


def test_it_asks_for_as_many_explanations_as_it_says() -> None:
    for question in (Vanished(4, 1, 3), Vanished(3, 2, 4)):
        facts = [
            *question.knowledge.ranks,
            *goal_facts(question.goal),
            *question.history().facts(),
            fact("explaining", question.steps),
        ]
        names = ("history", "intentions", "goal_persistence", "defaults", "diagnosis")
        texts = [question.knowledge.program, *map(theory, names)]
        most = {"max_unobserved": question.books, "max_name": 2, "max_len": 1}
        control = ground(texts, {"n": question.steps, **most}, facts)
        smallest = [(fact("number_unobserved", question.books, question.steps), True)]
        found, more = answer_sets(control, smallest, 100)
        assert (len(found), more) == (question.explanations, False)
