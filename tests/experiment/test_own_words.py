"""Constants that are called like words of messages and reasons are constants all the same."""

from pathlib import Path

import pytest

from benchmarks.own import Own
from testbed.config import ConfigError
from tests.experiment.gardens import GARDEN, PIECES

WORDS = ["wait", "finish", "none", "start", "stop", "fewer", "by", "step", "activity", "hpd"]
WORDS += ["true", "false", "obs", "select", "my_goal", "goal", "impossible", "holds", "occurs"]
WORDS += ["plan", "belief", "intention", "reason", "mental", "physical", "exogenous", "event"]
WORDS += ["unobserved", "distrusted", "defined", "count", "show", "null", "no", "_x"]
GOAL = ["stands(spade,south)", "-carries(tom,spade)"]
FINE = {"initial": ["fine_stands(tom,north_1)", "fine_stands(other_head,north_1)"]}
FINE["initial"] += ["fine_stands(spade_head,north_2)"]
COARSE = {"initial": ["stands(tom,north)", "stands(OTHER,north)", "stands(spade,north)"]}


def _told(folder: Path, other: str, fine: bool) -> tuple[str, list[tuple[object, ...]]]:
    """How a trial ends, and what is done and told step by step, where a tool has this name."""
    own = Own(
        folder, GARDEN.replace("OTHER", other), PIECES.replace("OTHER", other) if fine else ""
    )
    given = FINE if fine else COARSE
    initial = [literal.replace("OTHER", other) for literal in given["initial"]]
    ((record, moments),) = own.play(goal=GOAL, initial=initial, robots=["intentional"])
    told = [
        (m.decision.action, m.decision.trace.plan, m.decision.trace.reason, m.decision.trace.mental)
        for m in moments
    ]
    return record.outcome, told


@pytest.mark.parametrize("fine", [True, False])
@pytest.mark.parametrize("word", WORDS)
def test_the_name_of_a_thing_changes_nothing(word: str, fine: bool, tmp_path: Path) -> None:
    outcome, told = _told(tmp_path / "word", word, fine)
    assert outcome == "achieved"
    assert told == _told(tmp_path / "plain", "rake", fine)[1]


@pytest.mark.parametrize("word", ["wait", "none", "finish", "start", "stop"])
def test_an_action_is_not_called_like_one_of_the_robots_own(word: str, tmp_path: Path) -> None:
    own = Own(tmp_path, GARDEN.replace("OTHER", "rake").replace("lay(", f"{word}("))
    with pytest.raises(ConfigError) as refused:
        list(own.play(goal=GOAL, robots=["intentional"]))
    (line,) = str(refused.value).splitlines()
    assert "own.al:" in line
    assert f"'{word}'" in line
