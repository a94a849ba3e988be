"""Which explanation is preferred: exceptions to defaults before events, each as few as possible."""

from collections.abc import Callable, Iterable, Mapping

import pytest

from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Reasoner
from asp.language import Literal
from asp.reasoning import Knowledge, knowledge
from asp.reasoning.diagnosis import SELECT, Diagnosis, Explanation
from tests.agents.intentional.lives import OFFICE, Place, place
from tests.literals import parsed

LIBRARY = place("library")
WANTED = parsed(["loc(book1,office2)", "loc(cookbook1,office2)"])
HERE = parsed(["loc(rob1,office2)", "-in_hand(rob1,book1)", "-in_hand(rob1,book2)"])
ALONE = (*HERE, "-in_hand(rob1,cookbook1)")

Make = Callable[[Knowledge, tuple[str, ...], int], Reasoner]


@pytest.fixture(params=[ReferenceReasoner, IncrementalReasoner], ids=["reference", "incremental"])
def make(request: pytest.FixtureRequest) -> Make:
    reasoner: Make = request.param
    return reasoner


class Watching:
    """A robot that stands still and looks: a history and what a reasoner makes of it."""

    def __init__(self, make: Make, initial: Iterable[str], where: Place = LIBRARY) -> None:
        domain = knowledge(where.domain, where.source)
        self._reasoner = make(domain, WANTED if where is LIBRARY else WANTED[:1], 20)
        self._history = History()
        self._history.observe(parsed(initial), 0)
        self._history.happened(SELECT, True, 0)
        self.adopted = Explanation()

    def told(self, event: str, step: int) -> None:
        self._history.happened(Literal.parse(event), True, step)

    def sees(self, step: int, *literals: str) -> Diagnosis:
        """The explanation after it looked at this step."""
        self._history.step = step
        self._history.observe(parsed(literals), step)
        explained = self._reasoner.diagnose(self._history, self.adopted)
        self.adopted = explained.explanation
        return explained


def _of(explained: Diagnosis) -> tuple[list[str], list[tuple[int, str]]]:
    """The exceptions and the events."""
    diagnosis = explained.explanation
    return list(diagnosis.exceptions), [(e.step, e.action) for e in diagnosis.unobserved]


def _after(
    make: Make, seen: Mapping[int, tuple[str, ...]], initial: Iterable[str] = ALONE
) -> Diagnosis:
    """The explanation of what was seen, asked for step by step."""
    robot = Watching(make, initial)
    last = None
    for step in range(1, max(seen) + 1):
        last = robot.sees(step, *seen.get(step, ()))
    assert last is not None
    return last


def test_where_nothing_speaks_against_them_defaults_hold(make: Make) -> None:
    explained = _after(make, {1: ALONE})
    assert _of(explained) == ([], [])
    places = {literal for literal in explained.explanation.initial if literal.startswith("loc(b")}
    assert places == {"loc(book1,library)", "loc(book2,library)"}
    assert {"loc(cookbook1,kitchen)", "-locked(library)"} <= set(explained.explanation.initial)


def test_where_one_default_fails_the_next_one_holds(make: Make) -> None:
    explained = _after(make, {2: parsed(["-loc(book1,library)"])})
    assert _of(explained) == (["shelved(book1)"], [])
    assert "loc(book1,office1)" in explained.explanation.initial


def test_two_exceptions_are_preferred_to_one_event(make: Make) -> None:
    """One event alone would do: somebody took the book from the library at step 1."""
    explained = _after(
        make, {2: parsed(["-loc(book1,library)"]), 4: parsed(["-loc(book1,office1)"])}
    )
    assert _of(explained) == (["lent(book1)", "shelved(book1)"], [])


def test_four_exceptions_are_preferred_to_two_events(make: Make) -> None:
    explained = _after(make, {2: parsed(["loc(book1,kitchen)", "loc(book2,kitchen)"])})
    exceptions, events = _of(explained)
    assert exceptions == ["lent(book1)", "lent(book2)", "shelved(book1)", "shelved(book2)"]
    assert events == []


def test_a_stated_exception_is_none(make: Make) -> None:
    assert _of(_after(make, {2: parsed(["-loc(cookbook1,library)"])})) == ([], [])


def test_where_exceptions_do_not_suffice_there_was_an_event(make: Make) -> None:
    seen = {1: parsed(["loc(book1,library)"]), 3: parsed(["loc(book1,kitchen)"])}
    assert _of(_after(make, seen)) == ([], [(2, "exo_move(book1,kitchen)")])


def test_as_few_events_as_possible_even_if_that_takes_exceptions(make: Make) -> None:
    """Two events and no exception would do, or one event with two exceptions."""
    seen = {2: parsed(["loc(book1,kitchen)"]), 4: parsed(["loc(book1,office2)"])}
    explained = _after(make, seen)
    assert _of(explained) == (["lent(book1)", "shelved(book1)"], [(3, "exo_move(book1,office2)")])


def test_beside_an_event_that_is_needed_as_few_exceptions_as_possible(make: Make) -> None:
    """The event might as well have brought book2 to where it is seen from elsewhere."""
    seen = {2: parsed(["-loc(book2,kitchen)"]), 4: parsed(["loc(book2,kitchen)"])}
    assert _of(_after(make, seen)) == ([], [(3, "exo_move(book2,kitchen)")])


def test_what_was_reported_needs_no_exception(make: Make) -> None:
    robot = Watching(make, ALONE)
    robot.sees(1)
    robot.told("exo_move(book1,kitchen)", 1)
    robot.sees(2)
    assert _of(robot.sees(3, "loc(book1,kitchen)")) == ([], [])


def test_an_adopted_event_is_kept_while_it_explains_what_is_seen(make: Make) -> None:
    robot = Watching(make, ALONE)
    robot.sees(1, "loc(book1,library)")
    first = robot.sees(2, "-loc(book1,library)")
    later = robot.sees(4, "-loc(book1,library)")
    assert first.explanation == later.explanation
    assert [step for step, _ in _of(later)[1]] == [1]


def test_adopted_exceptions_are_kept_where_the_rest_was_otherwise(make: Make) -> None:
    """Of book1 neither default holds; where it is instead is assumed, and seen to be wrong."""
    robot = Watching(make, ALONE)
    robot.sees(1)
    first = robot.sees(2, "-loc(book1,library)", "-loc(book1,office1)")
    second = robot.sees(3, "-loc(book1,kitchen)")
    assert _of(first) == _of(second) == (["lent(book1)", "shelved(book1)"], [])
    assert "loc(book1,kitchen)" in first.explanation.initial
    assert "loc(book1,office2)" in second.explanation.initial


def test_one_exception_more_is_preferred_to_an_event_since(make: Make) -> None:
    """That somebody took the book from office1 would do, and would keep what is assumed."""
    robot = Watching(make, ALONE)
    robot.sees(1)
    robot.sees(2, "-loc(book1,library)")
    explained = robot.sees(3, "loc(book1,kitchen)")
    assert _of(explained) == (["lent(book1)", "shelved(book1)"], [])


def test_what_is_known_from_the_start_may_be_an_exception(make: Make) -> None:
    initial = LIBRARY.world.literals(
        LIBRARY.world.state(
            parsed(
                [
                    "loc(rob1,office2)",
                    "loc(book1,office2)",
                    "loc(book2,library)",
                    "loc(cookbook1,office1)",
                ]
            )
        )
    )
    robot = Watching(make, initial)
    explained = robot.sees(1, *initial)
    exceptions = ["cooking(cookbook1)", "lent(book1)", "shelved(book1)"]
    assert _of(explained) == (exceptions, [])
    assert explained.explanation.initial == ()
    assert robot.sees(2, *initial).explanation == explained.explanation


def test_what_is_in_the_hand_is_no_exception(make: Make) -> None:
    initial = (*(h for h in ALONE if h != "-in_hand(rob1,book1)"), "in_hand(rob1,book1)")
    assert _of(_after(make, {1: parsed(["loc(book1,office2)"])}, initial)) == ([], [])


def test_without_defaults_there_is_nothing_to_explain_until_something_moves(make: Make) -> None:
    robot = Watching(make, HERE, OFFICE)
    assumed = [
        {literal for literal in robot.sees(step, *seen).explanation.initial if literal[0] == "l"}
        for step, seen in (
            (1, ()),
            (2, parsed(["-loc(book1,kitchen)"])),
            (3, parsed(["-loc(book1,office1)", "locked(library)"])),
        )
    ]
    assert assumed == [
        {"loc(book1,kitchen)", "loc(book2,kitchen)"},
        {"loc(book1,office1)", "loc(book2,kitchen)"},
        {"loc(book1,office2)", "loc(book2,kitchen)", "locked(library)"},
    ]
    assert robot.adopted.unobserved == ()
