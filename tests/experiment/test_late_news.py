"""What becomes of a trial whose robot is told late what it had to explain before."""

from pathlib import Path

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

LATE = """\
name: late
domain: office
goal: ["loc(book2,office2)", "-in_hand(rob1,book2)"]
initial: ["loc(rob1,office1)", "loc(book1,office1)", "loc(book2,kitchen)"]
script: [{step: 2, action: "exo_move(book2,library)"}]
robots: [intentional, intentional-plain, intentional-joint, intentional-joint-staged]
link: inprocess
limits: {plan: 12, decision_s: null}
observability: {exo_move: {mode: always, delay: 3}}
"""


def test_a_robot_that_is_told_the_truth_goes_where_it_is_told(tmp_path: Path) -> None:
    """It saw that the book had gone, supposed another room, and is told the right one."""
    (tmp_path / "late.yaml").write_text(LATE, encoding="utf-8")
    specs = list(plan_trials(load_config(tmp_path / "late.yaml")))
    records = [play_trial(spec, InProcessRobot(make_robot)).record for spec in specs]
    assert [record.outcome for record in records] == ["achieved"] * 4
    # To the kitchen, where the book is not; to the library; with the book to office2: 7 actions.
    assert {len(record.actions) for record in records} == {7}
