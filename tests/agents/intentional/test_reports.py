"""What the robot makes of news: true, false and late, in both ways of reasoning."""

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Reasoner
from asp.language import Literal
from asp.reasoning import Knowledge, diagnosis, knowledge
from asp.reasoning.diagnosis import SELECT, Explanation
from asp.solving import LimitError, Limits, deciding
from tests.literals import parsed

SOURCE = (Path(__file__).parents[2] / "asp" / "reasoning" / "cart.al").read_text(encoding="utf-8")
CART = knowledge("cart", SOURCE)
START = ("at(left)", "-at(right)", "-shut", "-lit")
Happening = tuple[int, str]

both = pytest.mark.parametrize("reasoner", [ReferenceReasoner, IncrementalReasoner])
Make = Callable[[Knowledge, tuple[str, ...], int], Reasoner]


class Mind:
    """A history that grows, and the explanation that is held of it."""

    def __init__(
        self,
        reasoner: Make,
        start: Sequence[str] = START,
        goal: tuple[str, ...] = ("at(right)", "lit"),
    ) -> None:
        self.history = History()
        self.history.observe(parsed(start), 0)
        self.history.happened(SELECT, True, 0)
        self._reasoner = reasoner(CART, parsed(goal), 3)
        self.held = Explanation()
        self.kept = True

    def next(self, news: Sequence[Happening] = (), seen: Sequence[str] = ()) -> None:
        for step, event in news:
            self.history.happened(Literal.parse(event), True, step)
        self.history.step += 1
        self.history.observe(parsed(seen), self.history.step)
        explained = self._reasoner.diagnose(self.history, self.held)
        self.kept = explained.explanation == self.held.left(self.history)
        self.held = explained.explanation

    @property
    def assumed(self) -> tuple[list[Happening], list[Happening]]:
        unobserved = [(e.step, e.action) for e in self.held.unobserved]
        return unobserved, [(e.step, e.action) for e in self.held.distrusted]

    @property
    def believed(self) -> frozenset[str]:
        explained = self._reasoner.diagnose(self.history, self.held)
        return self._reasoner.intend(self.history, explained).believed


@both
def test_what_is_reported_is_believed_and_needs_no_explanation(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(news=[(1, "shut_gate")])
    assert mind.assumed == ([], [])
    assert "shut" in mind.believed
    mind.next(seen=["shut"])
    assert mind.assumed == ([], [])
    assert mind.kept


@both
@pytest.mark.parametrize(
    ("start", "goal", "told"), [("shut", "safe", "-my_goal"), ("-shut", "-safe", "my_goal")]
)
def test_what_is_told_of_a_defined_goal_is_explained(
    start: str, goal: str, told: str, reasoner: Make
) -> None:
    mind = Mind(reasoner, ["at(left)", "-at(right)", "lit", start], (goal,))
    mind.next()
    if start == "shut":
        mind.history.attempt(Literal.parse("open"), 1)
        mind.history.happened(Literal.parse("open"), True, 1)
    mind.next()
    mind.next(seen=[told])
    assert mind.assumed == ([(2, "shut_gate")], [])


@both
def test_a_report_that_is_seen_to_be_false_is_distrusted(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(news=[(1, "shut_gate")], seen=["-shut"])
    assert mind.assumed == ([], [(1, "shut_gate")])
    assert "shut" not in mind.believed
    mind.next(seen=["-shut"])
    assert mind.assumed == ([], [(1, "shut_gate")])
    assert mind.kept


@both
def test_a_report_of_what_cannot_have_happened_is_distrusted(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(news=[(1, "push(left)")])
    assert mind.assumed == ([], [(1, "push(left)")])


@both
def test_where_an_event_explains_as_well_the_report_is_believed(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(news=[(1, "push(right)")])
    mind.next(seen=parsed(["at(left)"]))
    assert mind.assumed == ([(2, "push(left)")], [])


@both
def test_one_false_report_is_preferred_to_two_events(reasoner: Make) -> None:
    """It was told that the cart went right and back again, and sees it on the right."""
    mind = Mind(reasoner)
    mind.next()
    mind.next(news=[(1, "push(right)")], seen=parsed(["at(right)"]))
    mind.next(news=[(2, "push(left)")], seen=parsed(["at(right)"]))
    assert mind.assumed == ([], [(2, "push(left)")])


@both
def test_of_two_reports_the_later_one_is_believed(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(news=[(1, "shut_gate")])
    mind.next(news=[(2, "shut_gate")], seen=["shut"])
    assert mind.assumed == ([], [(1, "shut_gate")])


@both
def test_late_news_replaces_what_was_assumed(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(seen=["shut"])
    mind.next(seen=parsed(["at(right)"]))
    assert mind.assumed == ([(1, "shut_gate"), (2, "push(right)")], [])
    mind.next(news=[(1, "shut_gate")])
    assert mind.assumed == ([(2, "push(right)")], [])
    assert mind.kept


@both
def test_late_news_is_not_forgotten_where_the_time_for_it_ran_out(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(seen=["shut"])
    mind.next(seen=parsed(["at(right)"]))
    with pytest.raises(LimitError), deciding(Limits(0)):
        mind.next(news=[(1, "shut_gate")])
    mind.next()
    assert mind.assumed == ([(2, "push(right)")], [])


@both
def test_a_report_is_not_forgotten_where_the_time_for_it_ran_out(reasoner: Make) -> None:
    """What is held was the best that there was time to find: it is larger than it need be."""
    mind = Mind(reasoner)
    for seen in ((), (), ("shut",)):
        mind.next(seen=seen)
    found = [(1, "push(right)"), (2, "push(left)"), (2, "shut_gate")]
    events = tuple(diagnosis.Happening(step, Literal.parse(event)) for step, event in found)
    mind.held = Explanation(events, proved=False)
    with pytest.raises(LimitError), deciding(Limits(0)):
        mind.next(news=[(3, "push(right)")])
    mind.next()
    assert mind.assumed == ([(2, "shut_gate")], [])


@both
def test_late_news_of_another_time_makes_the_assumption_needless(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next()
    mind.next(seen=["shut"])
    assert mind.assumed == ([(2, "shut_gate")], [])
    mind.next(news=[(1, "shut_gate")])
    assert mind.assumed == ([], [])
    assert not mind.kept


@both
def test_late_news_that_past_observations_refute_is_distrusted(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next(seen=["-shut"])
    mind.next()
    mind.next(news=[(1, "shut_gate")])
    assert mind.assumed == ([], [(1, "shut_gate")])


@both
def test_late_news_is_heeded_in_what_is_believed_now(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.next()
    mind.next(news=[(1, "push(right)")])
    assert mind.assumed == ([], [])
    assert "at(right)" in mind.believed


@both
def test_news_of_the_step_at_which_the_goal_is_selected_is_false(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next(news=[(0, "shut_gate")])
    assert mind.assumed == ([], [(0, "shut_gate")])


GATE = """
sorts
  robot = {rob}.
fluents
  inertial shut.
  inertial latched.
actions
  agent     knock(robot).
  exogenous shut_gate.
  exogenous unlatch.
  exogenous swing_open.
laws
  shut_gate  causes shut.
  shut_gate  causes latched.
  unlatch    causes -latched.
  swing_open causes -shut.
  impossible knock(R)   if -shut.
  impossible unlatch    if -latched.
  impossible swing_open if latched.
"""


@both
def test_a_report_is_believed_again_where_later_news_needs_it(reasoner: Make) -> None:
    """Only what was latched is unlatched: the gate was shut, and then opened."""
    gate = reasoner(knowledge("gate", GATE), parsed(["shut"]), 3)
    history = History(step=4)
    history.observe(parsed(["-shut", "-latched"]), 0)
    history.happened(SELECT, True, 0)
    history.happened(Literal.parse("shut_gate"), True, 1)
    history.observe(parsed(["-shut"]), 4)
    first = gate.diagnose(history, Explanation()).explanation
    assert [(e.step, e.action) for e in first.distrusted] == [(1, "shut_gate")]
    history.happened(Literal.parse("unlatch"), True, 2)
    history.happened(Literal.parse("swing_open"), True, 3)
    explained = gate.diagnose(history, first)
    assert explained.explanation == Explanation()


GUEST = """
sorts
  host  = {anna}.
  place = {hall, terrace, cellar}.
fluents
  inertial in(place).
actions
  agent     call(host, place).
  exogenous stroll(place).
laws
  call(H, P) causes in(P).
  stroll(P)  causes in(P).
  -in(P1) if in(P2), P1 != P2.
  impossible stroll(P) if in(P).
"""


@both
@pytest.mark.parametrize("in_time", [False, True])
@pytest.mark.parametrize("unknown", [False, True])
def test_an_invention_is_given_up_where_late_news_explains_everything(
    unknown: bool, in_time: bool, reasoner: Make
) -> None:
    """The guest left the hall for another place than was supposed: nothing needs be supposed."""
    text = (
        GUEST.replace("(place).\nactions", "(place).\n  inertial lit.\nactions")
        if unknown
        else GUEST
    )
    mind = reasoner(knowledge("guest", text), parsed(["in(hall)"]), 3)
    history = History(step=3)
    history.observe(parsed(["in(hall)", "-in(terrace)", "-in(cellar)"]), 0)
    history.happened(SELECT, True, 0)
    history.observe(parsed(["-in(hall)"]), 3)
    invented = mind.diagnose(history, Explanation()).explanation
    assert [(e.step, e.action) for e in invented.unobserved] == [(2, "stroll(terrace)")]
    history.happened(Literal.parse("stroll(cellar)"), True, 1)
    if not in_time:
        with pytest.raises(LimitError), deciding(Limits(0)):
            mind.diagnose(history, invented)
        history.step = 4
    explained = mind.diagnose(history, invented)
    assert (explained.explanation.unobserved, explained.explanation.distrusted) == ((), ())
    assert "in(cellar)" in mind.intend(history, explained).believed


@both
@pytest.mark.parametrize(
    ("goal", "then"), [parsed(["at(right)", "go(right)"]), ("safe", "switch_on")]
)
def test_what_is_assumed_of_the_start_is_planned_from(goal: str, then: str, reasoner: Make) -> None:
    """By default the gate is shut; the lamp is unknown, and assumed to be dark."""
    mind = reasoner(knowledge("cart", f"{SOURCE}\ndefaults\n  gate: shut.\n"), parsed([goal]), 3)
    history = History(step=1)
    history.observe(parsed(["at(left)", "-at(right)"]), 0)
    history.happened(SELECT, True, 0)
    intention = mind.intend(history, mind.diagnose(history, Explanation()))
    assert (intention.action, intention.plan) == ("start(1)", ("open", then))


@both
def test_a_goal_that_was_finished_is_a_past_like_others(reasoner: Make) -> None:
    mind = Mind(reasoner)
    mind.next()
    mind.history.attempt(Literal.parse("finish"), 1)
    mind.history.happened(Literal.parse("finish"), True, 1)
    mind.next(seen=["at(left)", "shut"])
    assert mind.assumed == ([(1, "shut_gate")], [])
