"""What the compressed past says of histories that turn on one part of it, as the whole one does."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import pytest

from asp.language import Literal, parse_description
from asp.reasoning.diagnosis import SELECT, Compression, Explanation, History
from testbed.world import world_of
from tests.agents.intentional.lives import Place
from tests.asp.reasoning.diagnosis.minds import TINY, WHOLE, Mind
from tests.literals import parsed

KILN = """
fluents
  inertial lit.
  inertial wet.
  inertial bent.
  defined  soft.
actions
  agent     kindle.
  agent     mend.
  exogenous rain.
  exogenous knock.
  exogenous drain.
laws
  kindle causes lit.
  mend   causes -wet.
  mend   causes -bent.
  rain   causes wet.
  knock  causes bent.
  drain  causes -wet.
  drain  causes -bent.
  soft if wet, bent.
  impossible kindle if wet.
"""
DRY = ("-lit", "-wet", "-bent")
LONG = 9
"""A step at which a history is compressed."""

Tell = Callable[[History], None]


def _believed(
    source: str, start: Sequence[str], *tell: Tell, compression: Compression = TINY
) -> Explanation:
    """What is adopted in the end, compressed or not, where news come from step `LONG` on."""
    place = Place("kiln", world_of(parse_description(source, "kiln.al")), source)
    goal = place.world.description.inertial[:1]
    compressed, whole = Mind(place, compression, goal), Mind(place, WHOLE, goal)
    histories = History(), History()
    for history in histories:
        history.observe(parsed(start), 0)
        history.happened(SELECT, True, 0)
    for step, news in enumerate(tell, LONG):
        for mind, history in zip((compressed, whole), histories, strict=True):
            history.step = step
            news(history)
            mind.think(history)
        assert compressed.adopted == whole.adopted
        assert compressed.diagnoser.belief.held == whole.diagnoser.belief.held
    return whole.adopted


def _reported(step: int, *events: str) -> Tell:
    return lambda history: [history.happened(Literal.parse(e), True, step) for e in events][-1]


def _told(step: int, *literals: str) -> Tell:
    return lambda history: history.observe(parsed(literals), step)


def _all(*tell: Tell) -> Tell:
    return lambda history: [each(history) for each in tell][-1]


def _attempted(step: int, action: str, happened: bool = True) -> Tell:
    def tell(history: History) -> None:
        history.attempt(Literal.parse(action), step)
        history.happened(Literal.parse(action), happened, step)
        if not happened:
            history.failed(Literal.parse(action), step)

    return tell


def test_an_attempt_that_kept_failing_was_rather_not_executed_than_hindered() -> None:
    adopted = _believed(KILN, DRY, _attempted(6, "kindle", happened=False))
    assert [e.action for e in adopted.distrusted] == ["kindle"]


def _hindered(step: int, action: str) -> Tell:
    def tell(history: History) -> None:
        history.attempt(Literal.parse(action), step)
        history.happened(Literal.parse(action), False, step)

    return tell


@pytest.mark.parametrize("step", [2, 4, 6])
def test_what_no_state_could_follow_was_hindered_by_what_nobody_saw(step: int) -> None:
    """No law says that it is impossible to kindle in a wet kiln."""
    source = KILN.replace("impossible kindle if wet", "-lit if wet")
    adopted = _believed(source, DRY, _hindered(step, "kindle"), _told(LONG, "-lit"))
    (rain,) = adopted.unobserved
    assert (rain.action, rain.step < step) == ("rain", True)
    assert not adopted.distrusted


REPORTS = """
fluents
  inertial lit.
actions
  agent douse.
{actions}
laws
  douse causes -lit.
"""


@pytest.mark.parametrize("merged", [False, True])
@pytest.mark.parametrize("sign", ["", "-"])
@pytest.mark.parametrize("partner", [1, 2, 3])
@pytest.mark.parametrize("names", ["ash bar cog dew", "dew cog bar ash", "cog ash dew bar"])
def test_of_reports_that_contradict_each_other_that_declared_first_is_believed(
    names: str, partner: int, sign: str, merged: bool
) -> None:
    """Two say that it is lit, and two that it is not; it may be put out, whichever it was."""
    events = names.split()
    believed = {events[0], events[partner]}
    source = REPORTS.format(actions="\n".join(f"  exogenous {event}." for event in events))
    for event in events:
        other = "-" if sign == "" else ""
        source += f"  {event} causes {sign if event in believed else other}lit.\n"
    put_out = [_attempted(7, "douse")] if merged else []
    adopted = _believed(source, ["-lit"], _all(_reported(6, *events), *put_out))
    assert {e.action for e in adopted.distrusted} == {*events} - believed


@pytest.mark.parametrize("events", [("rain", "knock"), ("knock", "rain")])
def test_of_two_reports_the_later_one_is_believed_whatever_came_of_either(
    events: tuple[str, str],
) -> None:
    first, last = events
    news = [_reported(5, first), _reported(6, last), _told(7, "-soft"), _attempted(7, "mend")]
    adopted = _believed(KILN, DRY, _all(*news))
    assert [(e.step, e.action) for e in adopted.distrusted] == [(5, first)]


@pytest.mark.parametrize(
    "truth", [("wet", "bent"), ("wet", "-bent"), ("-wet", "bent"), ("-wet", "-bent")]
)
def test_where_a_history_may_begin_in_too_many_states_none_is_forgotten(
    truth: tuple[str, ...],
) -> None:
    compression = replace(TINY, most=2)
    adopted = _believed(KILN, ["-lit"], _told(2, *truth), compression=compression)
    assert adopted.size == 0
    assert {*adopted.initial} == {*truth}


@pytest.mark.parametrize("late", [1, 4, 64])
@pytest.mark.parametrize("step", range(2, LONG))
def test_a_test_that_is_taken_for_wrong_leaves_nothing_to_explain(step: int, late: int) -> None:
    """That there was a knock, of which it is bent, is not forgotten with it."""
    wet = parsed(["wet"])

    def seen(history: History) -> None:
        history.observe(wet, step)
        history.doubt(wet, step)

    def wrong(history: History) -> None:
        history.distrust([(step, wet[0].atom)])
        history.observe(parsed(["bent"]), history.step)

    news, compression = _all(_reported(1, "knock"), seen), replace(TINY, late=late)
    assert _believed(KILN, DRY, news, compression=compression).size == 1
    assert _believed(KILN, DRY, news, wrong, compression=compression).size == 0


SLOPE = """
fluents
  inertial oiled.
  inertial bent.
  inertial pushed.
  inertial left.
  inertial right.
actions
  agent     push.
  exogenous slip.
  exogenous knock.
laws
  push  causes pushed.
  slip  causes bent.
  knock causes bent.
  -left  if pushed, right.
  -right if pushed, left.
  impossible slip if -oiled.
"""


@pytest.mark.parametrize("side", ["left", "right"])
def test_an_explanation_is_kept_whichever_outcome_an_action_had(side: str) -> None:
    """A knock explains all; that a slip does, too, where it was oiled, is no reason to doubt it."""
    start = ["-bent", "-pushed", "left", "right"]
    adopted = _believed(
        SLOPE, start, _all(_attempted(3, "push"), _told(6, "bent")), _told(LONG + 1, "oiled", side)
    )
    assert [e.action for e in adopted.unobserved] == ["knock"]
