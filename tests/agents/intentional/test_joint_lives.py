"""TI beside ATI and beside TI to the letter, in lives with little knowledge and doubtful news."""

from hypothesis import given, settings
from hypothesis import strategies as st

from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.joint import JointReasoner, StagedJointReasoner
from agents.intentional.reasoners import ReferenceReasoner
from agents.shared import Intention
from asp.language import parse_description
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import Diagnosis, Explanation
from benchmarks.offices import office
from testbed.protocol import Plans
from testbed.world import world_of
from tests.agents.intentional.lives import Place, Wish, live, place
from tests.literals import parsed

DEFAULTS = """
defaults
  shelved: loc(B, library) if book(B).
  open:    -locked(L).
  exception shelved if in_hand(R, B).
"""
ONE_BOOK = office(books=1, rooms=3) + DEFAULTS
WORLD = world_of(parse_description(ONE_BOOK, "office.al"))
SMALL = [Place("office", WORLD, ONE_BOOK, dark) for dark in (False, True)]
LIBRARY, OFFICE = place("library", dark=True), place("office")
DARK_OFFICE = place("office", dark=True)
MOST_ACTIONS = 5

wishes = st.dictionaries(
    st.integers(1, 8),
    st.builds(Wish, st.integers(0, 12), st.booleans(), st.booleans(), st.integers(0, 3)),
    max_size=3,
)
slow = settings(max_examples=8)


def _numbers(explained: Diagnosis | None) -> tuple[int, int]:
    assert explained is not None
    return explained.explanation.size, len(explained.explanation.exceptions)


def _kind(intention: Intention) -> str:
    return intention.action.partition("(")[0]


class BesideAti(StagedJointReasoner):
    """TI that insists, at each decision, on what it has in common with ATI."""

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        plan_limit: int,
        plans: Plans = "optimistic",
    ) -> None:
        super().__init__(knowledge, goal, min(plan_limit, self.most_actions), plans)
        self._ati = ReferenceReasoner(knowledge, goal, min(plan_limit, self.most_actions))

    most_actions = 12

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        intention = super().intend(history, explained)
        assert intention.under is not None
        smallest = self._ati.diagnose(history, Explanation())
        assert _numbers(intention.under) == _numbers(smallest)
        held = self._ati.diagnose(history, intention.under.explanation)
        believed = intention.under.explanation
        assert held.explanation == believed, "it believes in an explanation"
        assert held.indices == intention.under.indices
        ati = self._ati.intend(history, held)
        assert (ati.action, ati.believed) == (intention.action, intention.believed)
        assert len(ati.plan) == len(intention.plan)
        other = self._ati.intend(history, smallest)
        if _kind(intention) == _kind(other) == "start":
            assert len(intention.plan) <= len(other.plan)
        return intention


class BesideTheLetter(BesideAti):
    """It also insists that nothing is lost by what it finds beforehand."""

    most_actions = MOST_ACTIONS

    def __init__(
        self,
        knowledge: Knowledge,
        goal: tuple[str, ...],
        plan_limit: int,
        plans: Plans = "optimistic",
    ) -> None:
        super().__init__(knowledge, goal, plan_limit, plans)
        self._letter = JointReasoner(knowledge, goal, min(plan_limit, MOST_ACTIONS))

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        intention = super().intend(history, explained)
        letter = self._letter.intend(history, self._letter.diagnose(history, Explanation()))
        assert _numbers(letter.under) == _numbers(intention.under)
        assert _kind(letter) == _kind(intention)
        assert len(letter.plan) == len(intention.plan)
        return intention


@slow
@given(data=st.data(), where=st.sampled_from(SMALL), wishes=wishes)
def test_with_one_book_it_is_ti_to_the_letter(
    data: st.DataObject, where: Place, wishes: dict[int, Wish]
) -> None:
    literals = [text for fluent in WORLD.fluents for text in (fluent, f"-{fluent}")]
    goal = data.draw(st.lists(st.sampled_from(literals), min_size=1, max_size=2))
    initial = data.draw(st.sampled_from(list(WORLD.initial_states())))
    live(IntentionalRobot(BesideTheLetter), initial, goal, wishes, steps=12, where=where)


@slow
@given(data=st.data(), where=st.sampled_from([LIBRARY, OFFICE, DARK_OFFICE]), wishes=wishes)
def test_among_books_it_explains_as_ati_and_plans_no_longer(
    data: st.DataObject, where: Place, wishes: dict[int, Wish]
) -> None:
    initial = data.draw(st.sampled_from(list(where.world.initial_states())))
    goal = data.draw(
        st.sampled_from([parsed(["loc(book1,office2)"]), parsed(["in_hand(rob1,book2)"])])
    )
    live(IntentionalRobot(BesideAti), initial, goal, wishes, steps=9, where=where)


def test_ti_to_the_letter_looks_for_a_book_where_a_default_says() -> None:
    start = LIBRARY.world.state(
        parsed(
            [
                "loc(rob1,kitchen)",
                "loc(book1,library)",
                "loc(book2,office1)",
                "loc(cookbook1,kitchen)",
            ]
        )
    )
    goal = parsed(["in_hand(rob1,book1)"])
    life = live(IntentionalRobot(BesideTheLetter), start, goal, steps=6, where=LIBRARY)
    actions = [d.action for d in life.decisions]
    assert actions == ["wait", "move(rob1,library)", "pickup(rob1,book1)", "finish"]
