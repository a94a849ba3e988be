"""Actions that cannot be executed where a constraint contradicts their effects."""

from pathlib import Path

import pytest

from asp import Domain
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import (
    DiagnosisSessions,
    Explanation,
    Happening,
    History,
    IncrementalDiagnoser,
    ReferenceDiagnoser,
)
from benchmarks.own import Own
from tests.literals import parsed

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
  mate sees fuelled.
"""

# What is guarded is defined, and guards can be shooed away.
ORCHARD = """\
sorts
  grower = {ann}.
  tree   = {pear, plum}.
fluents
  inertial picked(tree).
  inertial watered.
  inertial dog_at(tree).
  defined  guarded(tree).
actions
  agent pick(tree).
  agent water.
  agent shoo.
  exogenous stray(tree).
laws
  pick(T)  causes picked(T) if watered.
  water    causes watered.
  stray(T) causes dog_at(T).
  shoo     causes -dog_at(T).
  guarded(T) if dog_at(T).
  -picked(T) if guarded(T).
sees
  ann sees picked(T).
  ann sees watered.
"""

# A lamp of two colours lights in one of them, whichever: to press has two outcomes.
LAMP = """\
sorts
  fitter = {kim}.
fluents
  inertial lit.
  inertial red.
  inertial green.
  inertial plugged.
  inertial blown.
actions
  agent plug.
  agent press.
  agent renew.
  exogenous blow.
laws
  plug  causes plugged.
  press causes lit if plugged.
  renew causes -blown.
  blow  causes blown.
  -red   if lit, green.
  -green if lit, red.
  -lit  if blown.
sees
  kim sees lit.
  kim sees plugged.
"""

INTENTIONAL = ("intentional", "intentional-plain", "intentional-joint", "intentional-joint-staged")
ROBOTS = (*INTENTIONAL, "traditional", "traditional-plain")
UNSEEN = [
    (HARBOUR, ["inside"], [], "close", ["fuel", "sail"], "gave_up"),
    (
        ORCHARD,
        ["picked(plum)"],
        [],
        "stray(plum)",
        ["water", "pick(plum)", "shoo", "pick(plum)"],
        "achieved",
    ),
    (LAMP, ["lit"], ["red", "green"], "blow", ["plug", "press", "renew", "press"], "achieved"),
]


@pytest.mark.parametrize("robot", INTENTIONAL)
def test_an_activity_with_one_is_futile(robot: str, tmp_path: Path) -> None:
    """The harbour is closed after the plan was made, before the first action."""
    own = Own(tmp_path, HARBOUR + "  mate sees closed.\n")
    script = [{"step": 1, "action": "close"}]
    told = {"goal": ["inside"], "initial": [], "robots": [robot], "relevance": "all"}
    ((record, _),) = own.play(**told, script=script, exogenous_while_thinking=True)
    assert [m.action for m in record.mental][:2] == ["start(1)", "stop(1)"]
    assert record.activities[0].plan == ["fuel", "sail"]
    assert (record.outcome, record.no_plan) == ("gave_up", "out of reach")


@pytest.mark.parametrize(("domain", "goal", "initial", "event", "attempts", "outcome"), UNSEEN)
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_failed_attempt_of_one_is_explained(
    robot: str,
    domain: str,
    goal: list[str],
    initial: list[str],
    event: str,
    attempts: list[str],
    outcome: str,
    tmp_path: Path,
) -> None:
    """Nobody sees the event beside the first action: the second one is attempted, and fails."""
    own = Own(tmp_path, domain)
    script = [{"at_action": 1, "action": event}]
    told = {"goal": goal, "initial": initial, "robots": [robot], "limits": {"plan": 3, "steps": 20}}
    ((record, moments),) = own.play(**told, script=script)
    answers = [str(moment.decision.action) for moment in moments]
    assert [answer for answer in answers if answer not in ("wait", "finish")] == attempts
    first, *_ = record.explanations
    assert [happened.action for happened in first.unobserved] == [event]
    assert record.outcome == outcome


REOPENED = HARBOUR.replace("laws\n", "  exogenous reopen.\nlaws\n  reopen causes -closed.\n")


def test_what_took_effect_was_possible_by_itself_whatever_happened_beside_it() -> None:
    """The harbour opened before the mate sailed, and not at the same time."""
    history = History()
    history.observe(parsed(["closed", "fuelled", "-inside"]), 0)
    for step, action in enumerate(parsed(["fuel", "sail"])):
        history.attempt(action, step)
        history.happened(action, True, step)
    history.step = 2
    known = knowledge("harbour", REOPENED)
    reference = ReferenceDiagnoser[History](known, ())
    for diagnoser in reference, IncrementalDiagnoser(DiagnosisSessions(known), (), 0, reference):
        found = diagnoser.diagnose(history, Explanation()).explanation
        assert found.unobserved == (Happening(0, *parsed(["reopen"])),)


def test_what_happens_at_once_may_be_possible_where_one_action_is_not() -> None:
    """To sail while the harbour opens: the diagram has such a transition, by the definition."""
    harbour = Domain(REOPENED, "harbour.al")
    assert harbour.successors("closed, fuelled", ["sail"]) == ()
    assert harbour.successors("closed, fuelled", ["sail", "reopen"]) == (
        frozenset(harbour.state("inside, fuelled")),
    )
