"""The page's example happens as it says."""

import re
from pathlib import Path

from tests.agents.intentional.executor.faulty_world import Faults
from tests.agents.intentional.executor.test_execution import carried_out, look

PAGE = Path(__file__).parents[4] / "docs" / "execution.md"
ROW = re.compile(r"^\| (\d+) \| `([^`]+)` \| (?:`([^`]+)`)? ?\|", re.MULTILINE)


def test_the_example_happens_as_shown() -> None:
    shown = ROW.findall(PAGE.read_text(encoding="utf-8"))
    went = carried_out(Faults(lies=[(look("room1_2"), 1)]))
    answers = [percept.visible for percept in went.percepts[1:]]
    happened = [
        (str(decision.step), decision.action, "".join(answer))
        for decision, answer in zip(went.decisions, [*answers, []], strict=True)
    ]
    assert shown == happened
