"""Messages survive the wire, and nothing else passes for one."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asp.language import Literal
from testbed.protocol import (
    PROTOCOL_VERSION,
    Decision,
    Event,
    Explanation,
    FineTrace,
    LinkError,
    Percept,
    Question,
    Task,
    Trace,
    decode,
    encode,
)
from testbed.protocol.messages import Message
from tests.link.scripted import percept

pytestmark = pytest.mark.versions

TEXT = st.text()
LITERALS = st.from_regex(
    r"-?[a-z]\w{0,3}(\([a-z0-9](,[a-z]\w{0,2})?\))?",
    fullmatch=True,
    alphabet=st.characters(codec="ascii"),
)
LISTS = st.lists(LITERALS)
WHOLE = st.integers(-(2**63), 2**64 - 1)
COUNT = st.integers(0, 2**31 - 1)
SECONDS = st.floats(0.0, 1e9)
MENTAL = st.from_regex(
    r"(start|stop)\([0-9]{1,9}\)", fullmatch=True, alphabet=st.characters(codec="ascii")
)
MAYBE = st.none() | st.booleans()

TASKS = st.builds(
    Task,
    trial=TEXT,
    robot=TEXT,
    domain=TEXT,
    source=TEXT,
    goal=LISTS,
    initial=LISTS,
    plan_limit=WHOLE,
    seed=WHOLE,
)
EVENTS = st.builds(Event, step=COUNT, action=LITERALS)
PERCEPTS = st.builds(
    Percept,
    trial=TEXT,
    step=COUNT,
    visible=LISTS,
    attempted=st.none() | LITERALS,
    happened=MAYBE,
    events=st.lists(EVENTS),
    goal_holds=MAYBE,
)
QUESTIONS = st.builds(Question, percept=PERCEPTS, task=st.none() | TASKS)
EXPLANATIONS = st.builds(Explanation, step=COUNT, unobserved=st.lists(EVENTS), exceptions=LISTS)
FINE = st.builds(
    FineTrace,
    abstract=st.none() | LITERALS,
    begun=st.none() | COUNT,
    plan=LISTS,
    plans=COUNT,
    happened=MAYBE,
    planning_time_s=SECONDS,
)
TRACES = st.builds(
    Trace,
    fine=st.none() | FINE,
    mental=st.none() | MENTAL,
    intention=st.none() | LITERALS,
    activity=st.none() | COUNT,
    plan=LISTS,
    belief=LISTS,
    explanation=st.none() | EXPLANATIONS,
    futile_at=st.none() | COUNT,
    reason=TEXT,
    plans=COUNT,
    planning_time_s=SECONDS,
    diagnosis_time_s=SECONDS,
)
DECISIONS = st.builds(
    Decision, trial=TEXT, step=COUNT, action=LITERALS, believes_goal=st.booleans(), trace=TRACES
)


@given(QUESTIONS | DECISIONS)
def test_decoding_undoes_encoding(message: Message) -> None:
    assert decode(encode(message), type(message)) == message


def test_literals_are_parsed_where_a_message_comes_in() -> None:
    told = decode(encode(Question(percept=percept())), Question).percept
    (seen,) = told.visible
    assert isinstance(seen, Literal)
    assert (seen.name, seen.arguments, seen.is_positive) == ("lit", ("lamp",), False)


@pytest.mark.parametrize("mental", [3, ["start(1)"], "", "start 1", "wait", "-stop(1)", "start(x)"])
def test_what_is_no_mental_action_is_refused_by_its_key(mental: object) -> None:
    with pytest.raises(ValueError, match="mental"):
        Trace(mental=mental)  # type: ignore[arg-type]
    answer = {"version": PROTOCOL_VERSION, "trial": "t", "step": 1, "action": "wait"}
    answer |= {"believes_goal": False, "trace": {"mental": mental}}
    with pytest.raises(LinkError, match="mental"):
        decode(msgspec.msgpack.encode(answer), Decision)


@pytest.mark.parametrize("text", ["", "lit lamp", "lit(lamp", "Lit", "x" * 10_001, 3, None])
def test_what_is_no_literal_is_refused_where_it_stands(text: object) -> None:
    trace = Trace(belief=["lit(lamp)", text])  # type: ignore[list-item]
    sent = encode(Decision(trial="t", step=1, action="wait", believes_goal=False, trace=trace))
    with pytest.raises(LinkError) as refused:
        decode(sent, Decision)
    (line,) = str(refused.value).splitlines()
    assert "trace.belief[" in line
    assert len(line) < 300


@given(st.binary())
def test_anything_else_is_refused(payload: bytes) -> None:
    with pytest.raises(LinkError):
        decode(payload, Decision)


@given(DECISIONS, st.data())
def test_a_message_cut_short_is_refused(message: Decision, data: st.DataObject) -> None:
    payload = encode(message)
    with pytest.raises(LinkError):
        decode(payload[: data.draw(st.integers(0, len(payload) - 1))], Decision)


@given(WHOLE.filter(lambda version: version != PROTOCOL_VERSION))
def test_another_version_is_refused_by_its_number(version: int) -> None:
    question = Question(version=version, percept=percept())
    with pytest.raises(LinkError, match=f"protocol version {version}, understood is 1"):
        decode(encode(question), Question)


def test_a_message_without_version_is_refused() -> None:
    unversioned = {"percept": percept(), "task": None}
    with pytest.raises(LinkError, match="version"):
        decode(msgspec.msgpack.encode(unversioned), Question)


def test_one_message_does_not_pass_for_another() -> None:
    with pytest.raises(LinkError, match="not a Decision"):
        decode(encode(Question(percept=percept())), Decision)
