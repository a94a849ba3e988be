"""Cases for the theory of planning at the fine resolution.

A robot in a row of two cells, a box in one of them: the domain is small enough to be told by facts.
"""

from dataclasses import dataclass

from tests.asp.theories.axioms import Claim, Inconsistent, Program, Without, never, possible

DOMAIN = """\
#const n = 1.
step(0..n).
cell(a). cell(b).
inertial(at(C)) :- cell(C).
inertial(box(C)) :- cell(C).
inertial(held).
inertial(seen_at(C)) :- cell(C).
inertial(seen_box(C)) :- cell(C).
inertial(felt).
agent_action(go(C)) :- cell(C).
agent_action(take).
agent_action(look_at(C)) :- cell(C).
agent_action(look_box(C)) :- cell(C).
agent_action(feel).
holds(F,I+1)  :- inertial(F), holds(F,I),  not -holds(F,I+1), step(I), I < n.
-holds(F,I+1) :- inertial(F), -holds(F,I), not holds(F,I+1),  step(I), I < n.
-holds(at(C1),I) :- holds(at(C2),I), cell(C1), C1 != C2.
holds(at(C),I+1) :- occurs(go(C),I), I < n.
holds(held,I+1) :- occurs(take,I), I < n.
:- occurs(take,I), holds(at(C),I), not holds(box(C),I).
:- occurs(go(C),I), holds(at(C),I).
holds(seen_at(C),I+1) :- occurs(look_at(C),I), holds(at(C),I), I < n.
holds(seen_box(C),I+1) :- occurs(look_box(C),I), holds(at(C),I), holds(box(C),I), I < n.
holds(felt,I+1) :- occurs(feel,I), holds(held,I), I < n.
tests_fluent(look_at(C),at(C),seen_at(C)) :- cell(C).
tests_fluent(look_box(C),box(C),seen_box(C)) :- cell(C).
tests_fluent(feel,held,felt).
changes(go(C),at(C)) :- cell(C).
changes(take,held).
1 { holds(F,0); -holds(F,0) } 1 :- inertial(F).
"""

_HERE = "certain(at(a))."
_BOX = _HERE + " candidate(1,box(a)). candidate(1,box(b)). deals_with(take,1)."

_MOVE_AND_LOOK = ("occurs(go(b),0)", "occurs(look_at(b),1)")


@dataclass(frozen=True)
class FineCase:
    """A claim that follows from a rule, counted from 1, of a paragraph, and fails without it."""

    paragraph: str
    rule: int
    sentence: str
    rules: str
    claim: Claim
    n: int = 0

    @property
    def number(self) -> str:
        return f"fine_planning.{self.paragraph}"

    @property
    def without(self) -> Without:
        return Without(self.number, self.rule)

    @property
    def program(self) -> Program:
        return Program(DOMAIN, ("fine_planning",), self.rules, {"n": self.n})


CASES = (
    FineCase("a", 1, "what is certain holds", _HERE, never("-holds(at(a),0)")),
    FineCase("b", 1, "what is certain is not ruled out", _HERE, possible()),
    FineCase("b", 2, "a candidate is not ruled out", _BOX, possible("holds(box(b),0)")),
    FineCase("b", 3, "all else is false", _HERE, never("holds(held,0)")),
    FineCase("c", 1, "one candidate is true", _BOX, never("-holds(box(a),0)", "-holds(box(b),0)")),
    FineCase("d", 1, "actions are chosen", _HERE, possible("occurs(go(b),0)"), n=2),
    FineCase("e", 1, "what is wanted holds in the end", _HERE + " wanted(at(b)).", Inconsistent()),
    FineCase("e", 2, "what is unwanted does not", _HERE + " unwanted(at(a)).", Inconsistent()),
    FineCase("f", 1, "a test tells of a fluent", _HERE, possible(*_MOVE_AND_LOOK), n=2),
    FineCase(
        "f", 2, "what an action changes is to be tested", _HERE, never("occurs(go(b),0)"), n=1
    ),
    FineCase(
        "f",
        3,
        "it is to be tested until it is",
        _HERE,
        never("occurs(go(b),0)", "occurs(look_box(b),1)", "occurs(feel,2)"),
        n=3,
    ),
    FineCase("g", 1, "tests wait for no test", _HERE, possible(*_MOVE_AND_LOOK), n=2),
    FineCase(
        "g",
        2,
        "nothing else is done before the test",
        _HERE,
        never("occurs(go(b),0)", "occurs(go(a),1)"),
        n=4,
    ),
    FineCase("g", 3, "a plan does not end before it", _HERE, never("occurs(go(b),0)"), n=1),
    FineCase(
        "h",
        1,
        "what a test has found can be dealt with",
        _BOX,
        possible("occurs(look_box(a),0)", "occurs(take,1)", "occurs(feel,2)"),
        n=3,
    ),
    FineCase("h", 2, "what no test has found cannot", _BOX, never("occurs(take,0)"), n=2),
)
