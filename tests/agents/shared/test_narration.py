"""Messages in other names and steps: constants may be called like any word of a text."""

import pickle

from agents.shared import Narration, Step, listed, retold
from asp.language import Literal
from testbed.protocol import Contradiction, Event, Explanation, Trace

AT, CLEAR = Literal.parse("at(futile,step)"), Literal.parse("-clear(by)")
NAMES = {"futile": "step", "step": "futile", "by": "impossible"}
REASON = Narration("futile: ", AT, " by step ", Step(3), " with ", listed([CLEAR, AT]))
TRACE = Trace(
    intention=AT,
    plan=[AT],
    belief=[CLEAR.atom],
    reason=REASON,
    plans=3,
    activity=3,
    futile_at=3,
    contradictions=[Contradiction(step=3, observed=Narration("hpd(", CLEAR, ")"), believed=AT)],
    explanation=Explanation(step=3, unobserved=[Event(step=3, action=AT)], exceptions=[CLEAR]),
)


def test_words_stay_and_constants_change() -> None:
    told = retold(TRACE, lambda literal: literal.renamed(NAMES))
    assert told.reason == (
        "futile: at(step,futile) by step 3 with -clear(impossible), at(step,futile)"
    )
    assert (told.intention, *told.plan) == ("at(step,futile)",) * 2
    assert told.belief == ["clear(impossible)"]
    assert [(c.observed, c.believed) for c in told.contradictions] == [
        ("hpd(-clear(impossible))", "at(step,futile)")
    ]
    assert told.explanation is not None
    assert told.explanation.exceptions == ["-clear(impossible)"]
    assert [event.action for event in told.explanation.unobserved] == ["at(step,futile)"]


def test_steps_change_and_counts_stay() -> None:
    told = retold(TRACE, step=lambda step: step + 10)
    assert told.reason.startswith("futile: at(futile,step) by step 13 with")
    assert (told.futile_at, told.plans, told.activity) == (13, 3, 3)
    assert told.explanation is not None
    assert [told.explanation.step, told.contradictions[0].step] == [13, 13]
    assert [event.step for event in told.explanation.unobserved] == [13]


def test_a_text_travels_with_its_parts() -> None:
    copied = pickle.loads(pickle.dumps(REASON))
    assert retold(copied, step=lambda _: 7) == REASON.replace("step 3", "step 7")
