"""Actions that cannot be executed where a constraint contradicts their effects."""

from pathlib import Path

import pytest

from benchmarks.own import Own

# Nobody says that it is impossible to sail into a harbour that is closed: it is so all the same.
HARBOUR = """\
sorts
  crew = {mate}.
fluents
  inertial inside.
  inertial closed.
  inertial fuelled.
actions
  agent sail.
  agent fuel.
  exogenous close.
laws
  sail causes inside if fuelled.
  fuel causes fuelled.
  close causes closed.
  -inside if closed.
sees
  mate sees inside.
  mate sees closed.
  mate sees fuelled.
"""


ROBOTS = ("intentional", "intentional-plain", "intentional-joint", "intentional-joint-staged")


@pytest.mark.parametrize("robot", ROBOTS)
def test_an_activity_with_one_is_futile(robot: str, tmp_path: Path) -> None:
    """The harbour is closed after the plan was made, before the first action."""
    own = Own(tmp_path, HARBOUR)
    script = [{"step": 1, "action": "close"}]
    told = {"goal": ["inside"], "initial": [], "robots": [robot], "relevance": "all"}
    ((record, _),) = own.play(**told, script=script, exogenous_while_thinking=True)
    assert [m.action for m in record.mental][:2] == ["start(1)", "stop(1)"]
    assert record.activities[0].plan == ["fuel", "sail"]
    assert (record.outcome, record.no_plan) == ("gave_up", "out of reach")
