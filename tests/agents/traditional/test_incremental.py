"""TP that reasons incrementally decides as TP solved from scratch, decision by decision."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import reasoners
from agents.intentional.activities import History as IntentionalHistory
from agents.shared import Intention
from agents.traditional import TraditionalRobot
from agents.traditional.reasoners import IncrementalReasoner, ReferenceReasoner
from asp.language import Literal
from asp.reasoning import knowledge
from asp.reasoning.diagnosis import Explanation, History, InconsistentHistoryError
from tests.agents.both_ways import both_ways
from tests.agents.intentional import test_reports as cart
from tests.agents.intentional.lives import (
    BOTH_IN_THE_LIBRARY,
    DOMAIN,
    GOAL_LITERALS,
    SOURCE,
    STATES,
    WORLD,
    Wish,
    live,
)
from tests.literals import parsed

BOTH = both_ways(IncrementalReasoner, ReferenceReasoner)

wishes = st.dictionaries(
    st.integers(1, 20), st.builds(Wish, st.integers(0, 8), st.booleans()), max_size=4
)


@settings(max_examples=15)
@given(initial=st.sampled_from(STATES), wishes=wishes)
def test_every_decision_of_a_life_is_the_same(initial: int, wishes: dict[int, Wish]) -> None:
    live(TraditionalRobot(BOTH), initial, BOTH_IN_THE_LIBRARY, wishes, steps=30)


@settings(max_examples=10)
@given(
    initial=st.sampled_from(STATES),
    goal=st.lists(st.sampled_from(GOAL_LITERALS), min_size=1, max_size=2),
    wishes=wishes,
)
def test_whatever_the_goal(initial: int, goal: list[str], wishes: dict[int, Wish]) -> None:
    live(TraditionalRobot(BOTH), initial, goal, wishes, steps=15)


def test_what_only_an_event_at_step_0_explains_is_explained_where_no_goal_is_selected() -> None:
    history = History(step=1)
    unlocked = next(state for state in STATES if WORLD.holds(state, "-locked(library)"))
    history.observe(WORLD.literals(unlocked), 0)
    history.observe(parsed(["locked(library)"]), 1)
    office = knowledge(DOMAIN, SOURCE)
    for reasoner in (IncrementalReasoner, ReferenceReasoner):
        diagnosis = reasoner(office, BOTH_IN_THE_LIBRARY, 20).diagnose(history, Explanation())
        assert diagnosis.explanation.unobserved == ((0, "exo_lock(library)"),)
    selecting = IntentionalHistory(step=1, moments=history.moments)
    selecting.happened(Literal.parse("select(my_goal)"), True, 0)
    for intentional in (reasoners.IncrementalReasoner, reasoners.ReferenceReasoner):
        with pytest.raises(InconsistentHistoryError):
            intentional(office, BOTH_IN_THE_LIBRARY, 20).diagnose(selecting, Explanation())


@pytest.mark.parametrize("reasoner", [IncrementalReasoner, ReferenceReasoner])
def test_no_plan_begins_with_a_report_that_is_distrusted(
    reasoner: type[IncrementalReasoner] | type[ReferenceReasoner],
) -> None:
    history = History(step=2)
    history.observe(parsed(cart.START), 0)
    history.happened(Literal.parse("shut_gate"), True, 1)
    history.observe(parsed(["-shut"]), 2)
    assert _plan(reasoner, cart.SOURCE, parsed(["at(right)"]), history).plan == ("go(right)",)


@pytest.mark.parametrize("reasoner", [IncrementalReasoner, ReferenceReasoner])
@pytest.mark.parametrize(("goal", "plan"), [("-shut", "open"), ("lit", "switch_on")])
def test_plans_begin_where_defaults_and_the_order_of_explanations_say(
    goal: str, plan: str, reasoner: type[IncrementalReasoner] | type[ReferenceReasoner]
) -> None:
    history = History(step=1)
    history.observe(parsed(["at(left)", "-at(right)"]), 0)
    source = f"{cart.SOURCE}\ndefaults\n  gate: shut.\n"
    assert _plan(reasoner, source, (goal,), history).plan == (plan,)


def _plan(
    make: type[IncrementalReasoner] | type[ReferenceReasoner],
    source: str,
    goal: tuple[str, ...],
    history: History,
) -> Intention:
    reasoner = make(knowledge("cart", source), parsed(goal), 3)
    return reasoner.intend(history, reasoner.diagnose(history, Explanation()))


@pytest.mark.parametrize("reasoner", [IncrementalReasoner, ReferenceReasoner])
@pytest.mark.parametrize("true", ["", "shut", "lit", "shut lit"])
def test_what_is_assumed_of_the_start_is_believed(
    true: str, reasoner: type[IncrementalReasoner] | type[ReferenceReasoner]
) -> None:
    history = History(step=1)
    history.observe(parsed(["at(left)", "-at(right)"]), 0)
    defaults = "".join(f"  {name}: {name}.\n" for name in true.split())
    source = f"{cart.SOURCE}\ndefaults\n{defaults}" if defaults else cart.SOURCE
    believed = _plan(reasoner, source, ("at(right)",), history).believed
    assert believed - {"safe"} == {"at(left)", *true.split()}
