"""Cases for the theory of defaults, and for what is kept of an explanation."""

from __future__ import annotations

from tests.asp.reasoning.stories import GATE_OPEN, GOAL, Case, failed, happened, lines
from tests.asp.theories.axioms import Always, never, possible

_LAMP_LIT = "default(lamp,lit,true)."
_LAMP_OUT = "default(lamp,lit,false)."
_NO_EXCEPTION = ":- not number_exceptions(0)."
_EXCEPTION = ":- not exception(lamp)."
_UNKNOWN_LAMP = lines("holds(at(left),0). -holds(shut,0). fluent_rank(lit,0).", GOAL)
_PAST = lines(GATE_OPEN, GOAL, "current_step(1). explaining(1).")
_NEWS = lines(_PAST, happened(0, "shut_gate"))

CASES = (
    Case(
        "defaults.a",
        "what an initial state must have one of is not missing altogether",
        lines(GOAL, "initially(0,at(left)). initially(0,at(right))."),
        never("-holds(at(left),0)", "-holds(at(right),0)"),
        rule=1,
    ),
    Case(
        "defaults.b",
        "a default whose body holds is in force",
        lines(_LAMP_LIT, _NO_EXCEPTION),
        Always("holds(lit,0)"),
        rule=1,
    ),
    Case(
        "defaults.c",
        "what usually is true at the start is true",
        lines(_LAMP_LIT, _NO_EXCEPTION),
        Always("holds(lit,0)"),
        rule=1,
    ),
    Case(
        "defaults.c",
        "what usually is false at the start is false",
        lines(_LAMP_OUT, _NO_EXCEPTION),
        Always("-holds(lit,0)"),
        rule=2,
    ),
    Case(
        "defaults.d",
        "a default gives way to what is seen",
        lines(_LAMP_LIT, "obs(lit,false,0)."),
        possible("-holds(lit,0)"),
        rule=1,
    ),
    Case(
        "defaults.d",
        "an exception to what usually is true is false",
        lines(_LAMP_LIT, _EXCEPTION),
        Always("-holds(lit,0)"),
        rule=2,
    ),
    Case(
        "defaults.d",
        "an exception to what usually is false is true",
        lines(_LAMP_OUT, _EXCEPTION),
        Always("holds(lit,0)"),
        rule=3,
    ),
    Case(
        "defaults.e",
        "exceptions are counted by their defaults",
        lines(_LAMP_LIT, "default(gate,shut,false). obs(lit,false,0). obs(shut,true,0)."),
        Always("number_exceptions(2)"),
        rule=1,
    ),
    Case(
        "diagnosis.a",
        "where the explanation is kept nothing else happened unnoticed",
        lines(_PAST, "keep."),
        never("unobserved(shut_gate,0)"),
        limit=2,
        rule=1,
    ),
    Case(
        "diagnosis.a",
        "where the explanation is kept what it assumes happened",
        lines(_PAST, "keep. adopted(shut_gate,0)."),
        Always("unobserved(shut_gate,0)"),
        limit=2,
        rule=2,
    ),
    Case(
        "diagnosis.a",
        "where the explanation is kept no other report is distrusted",
        lines(_NEWS, "keep."),
        never("distrusted(shut_gate,0)"),
        limit=2,
        rule=3,
    ),
    Case(
        "diagnosis.a",
        "where the explanation is kept what it distrusts stays so",
        lines(_NEWS, "keep. adopted_distrusted(shut_gate,0)."),
        Always("distrusted(shut_gate,0)"),
        limit=2,
        rule=4,
    ),
    Case(
        "diagnosis.a",
        "where the explanation is kept there is no other exception",
        lines(_LAMP_LIT, "keep."),
        never("exception(lamp)"),
        rule=5,
    ),
    Case(
        "diagnosis.a",
        "where the explanation is kept its exceptions stay so",
        lines(_LAMP_LIT, "keep. adopted_exception(lamp)."),
        Always("exception(lamp)"),
        rule=6,
    ),
    Case(
        "diagnosis.c",
        "an attempt that kept failing may not have been executed, though it was possible",
        lines(_PAST, failed(0, "switch_on"), "failing(switch_on,0)."),
        possible("distrusted(switch_on,0)"),
        limit=1,
        rule=1,
    ),
    Case(
        "diagnosis.b",
        "what nobody saw at the start is unknown",
        _UNKNOWN_LAMP,
        Always("unknown(lit)"),
        rule=1,
    ),
    Case(
        "diagnosis.b",
        "where the beginning is kept what was false stays so",
        lines(_UNKNOWN_LAMP, "keep_initial. adopted_initial(lit,false)."),
        Always("-holds(lit,0)"),
        rule=2,
    ),
    Case(
        "diagnosis.b",
        "where the beginning is kept what was true stays so",
        lines(_UNKNOWN_LAMP, "keep_initial. adopted_initial(lit,true)."),
        Always("holds(lit,0)"),
        rule=3,
    ),
)

CONDITIONS = (
    Case(
        "defaults.b",
        "a default to which a stated exception applies says nothing",
        lines(_LAMP_LIT, "stated_exception(lamp). obs(lit,false,0)."),
        Always("number_exceptions(0)"),
        rule=1,
        condition="not stated_exception(D)",
    ),
    Case(
        "defaults.c",
        "what usually is true may be false",
        lines(_LAMP_LIT, "obs(lit,false,0)."),
        possible(),
        rule=1,
        condition="not exception(D)",
    ),
    Case(
        "defaults.c",
        "what usually is false may be true",
        lines(_LAMP_OUT, "obs(lit,true,0)."),
        possible(),
        rule=2,
        condition="not exception(D)",
    ),
    Case(
        "defaults.d",
        "only an exception is false for its being one",
        lines(_LAMP_LIT),
        possible("holds(lit,0)"),
        rule=2,
        condition="exception(D)",
    ),
    Case(
        "defaults.d",
        "only an exception is true for its being one",
        lines(_LAMP_OUT),
        possible("-holds(lit,0)"),
        rule=3,
        condition="exception(D)",
    ),
    Case(
        "diagnosis.a",
        "an explanation that need not be kept is open to other exceptions",
        lines(_LAMP_LIT),
        possible("exception(lamp)"),
        rule=5,
        condition="keep",
    ),
    Case(
        "diagnosis.a",
        "an explanation that need not be kept is open to fewer exceptions",
        lines(_LAMP_LIT, "adopted_exception(lamp)."),
        possible("holds(lit,0)"),
        rule=6,
        condition="keep",
    ),
    Case(
        "diagnosis.a",
        "an event that was reported since need not be assumed",
        lines(_NEWS, "keep. adopted(shut_gate,0)."),
        possible(),
        limit=2,
        rule=2,
        condition="not hpd(PEA,true,I)",
    ),
    Case(
        "diagnosis.b",
        "what was seen at the start is not assumed: true",
        lines(GOAL, "fluent_rank(lit,0). obs(lit,true,0)."),
        never("unknown(lit)"),
        rule=1,
        condition="not obs(F,true,0)",
    ),
    Case(
        "diagnosis.b",
        "what was seen at the start is not assumed: false",
        lines(GOAL, "fluent_rank(lit,0). obs(lit,false,0)."),
        never("unknown(lit)"),
        rule=1,
        condition="not obs(F,false,0)",
    ),
    Case(
        "diagnosis.b",
        "a beginning that need not be kept may have been otherwise: true",
        lines(_UNKNOWN_LAMP, "adopted_initial(lit,false)."),
        possible("holds(lit,0)"),
        rule=2,
        condition="keep_initial",
    ),
    Case(
        "diagnosis.b",
        "a beginning that need not be kept may have been otherwise: false",
        lines(_UNKNOWN_LAMP, "adopted_initial(lit,true)."),
        possible("-holds(lit,0)"),
        rule=3,
        condition="keep_initial",
    ),
)
