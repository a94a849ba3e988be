"""Facts of short stories about the cart, and the cases that are told with them."""

from dataclasses import dataclass
from pathlib import Path

from tests.asp.theories.axioms import Claim, Program, Without, domain_text

CART = str(Path(__file__).with_name("cart.al"))
GOAL = "goal(at(right),true)."
GATE_OPEN = "holds(at(left),0). -holds(shut,0). -holds(lit,0)."
GATE_SHUT = "holds(at(left),0). holds(shut,0). -holds(lit,0)."
OTHER_GOAL = "possible_goal(other)."

_ACTING = ("history", "intentions")
_THEORIES = {
    "acting": _ACTING,
    "diagnosis": (*_ACTING, "defaults", "order", "diagnosis"),
    "planning": (*_ACTING, "planning"),
}


@dataclass(frozen=True)
class Case:
    """A claim that follows from axiom `number`, and from its rule `rule` (from 1) if given.

    The claim is true of the program and false without that axiom, or without that rule alone, or
    without that condition of the rule.
    """

    number: int | str
    sentence: str
    rules: str
    claim: Claim
    n: int = 1
    rule: int | None = None
    limit: int = 0
    condition: str | None = None

    @property
    def without(self) -> Without:
        return Without(self.number, self.rule, self.condition)

    @property
    def program(self) -> Program:
        constants = {"n": self.n, "max_name": 2, "max_len": 2}
        if isinstance(self.number, str):
            theories = _THEORIES["diagnosis"]
            constants["max_unobserved"] = self.limit
        elif self.number < 25:
            theories = _THEORIES["acting"]
        elif self.number < 28:
            theories = _THEORIES["diagnosis"]
            constants["max_unobserved"] = self.limit
        else:
            theories = _THEORIES["planning"]
        return Program(domain_text(CART), theories, self.rules, constants)


def theories_for(purpose: str) -> tuple[str, ...]:
    """The theories that act, diagnose or plan."""
    return _THEORIES[purpose]


def lines(*facts: str) -> str:
    return "\n".join(facts)


def occurs(*actions: str) -> str:
    """One action a step, from step 0 on."""
    return " ".join(f"occurs({action},{step})." for step, action in enumerate(actions))


def may_occur(step: int, *actions: str) -> str:
    return "{ " + "; ".join(f"occurs({action},{step})" for action in actions) + " }."


def happened(step: int, *actions: str) -> str:
    """Events that somebody reported."""
    return " ".join(f"hpd({action},true,{step})." for action in actions)


def did(step: int, action: str) -> str:
    """An attempt that succeeded."""
    return f"attempt({action},{step}). hpd({action},true,{step})."


def failed(step: int, action: str) -> str:
    """An attempt that did not."""
    return f"attempt({action},{step}). hpd({action},false,{step})."


def activity(name: int, *plan: str) -> str:
    """An activity for the goal that was built earlier."""
    components = (
        f"activity_component({name},{index},{action})."
        for index, action in enumerate(plan, start=1)
    )
    return f"activity_goal({name},my_goal). activity_length({name},{len(plan)})." + "".join(
        components
    )


def intending(step: int) -> str:
    """The robot looks for its intended action, with nothing to explain."""
    return f"current_step({step}). explanation(0,{step})."


SELECTED = happened(0, "select(my_goal)")
STARTED = lines(SELECTED, did(1, "start(1)"))
STOPPED = lines(STARTED, did(2, "stop(1)"))
