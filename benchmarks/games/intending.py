"""Whether plans and reasons of robots are true of what they believe, by brute force."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from benchmarks.games.explaining import Node
from benchmarks.games.faults import Fault, Turn
from benchmarks.games.literals import Plan
from benchmarks.games.office import State

_IMPOSSIBLE = re.compile(r"futile: (\S+) is impossible at step \d+(?: with (.*))?")
_COMMA = re.compile(r", ?(?![^(]*\))")


def plan_faults(turn: Turn, state: State, is_first: bool = True) -> Iterator[Fault]:
    """A new plan can be executed, reaches the goal, and none is shorter; `is_first`: or earlier."""
    plan, goal = tuple(map(str, turn.decision.trace.plan)), turn.told.rules.goal
    if not reaches(turn, state, plan):
        yield turn.fault("plan", f"{plan} does not lead to the goal")
        return
    shortest = turn.office.shortest(state, goal)
    assert shortest is not None, "the plan leads to the goal"
    if len(plan) > len(shortest) or len(plan) > turn.plan_limit:
        yield turn.fault("plan", f"{plan}; shorter is: {shortest}")
    elif is_first and plan != shortest:
        yield turn.fault("plan", f"{plan}; first in the order of declaration is: {shortest}")


def no_plan_faults(turn: Turn, state: State) -> Iterator[Fault]:
    """Where a robot gives up there is no plan within the limit, for the reason told."""
    told = turn.decision.trace.no_plan
    least = turn.office.distances(turn.told.rules.goal).get(state)
    if least is not None and least <= turn.plan_limit:
        yield turn.fault("plan", f"gives up: {told}; a plan has {least} actions")
    expected = "out of reach" if least is None else "beyond the limit"
    if told != expected and not (told == "not known" and turn.is_limited):
        yield turn.fault("plan", f"gives up: {told}; it is {expected}")


def reaches(turn: Turn, state: State, plan: Sequence[str]) -> bool:
    """Whether a plan is executable from a state until the goal holds (35), (36)."""
    return broken_at(turn, state, plan) is None


def broken_at(turn: Turn, state: State, plan: Sequence[str]) -> int | None:
    """The first action of a plan that is impossible, or its length; None if it succeeds."""
    for number, action in enumerate(plan):
        after = turn.office.after(state, frozenset([action]))
        if after is None:
            return number
        if turn.holds(after):
            return None
        state = after
    return len(plan)


@dataclass
class Intentions:
    """The activities of an intentional robot, and what it has to intend.

    `joint` robots intend what is best under any smallest explanation.
    """

    joint: bool
    plans: list[Plan] = field(default_factory=list)
    active: int = 0

    def faults(self, turn: Turn, state: State) -> Iterator[Fault]:
        """Of a decision in the believed state; it is then part of what is known."""
        decision, trace = turn.decision, turn.decision.trace
        told = self._told(turn)
        nodes = [node for node in turn.ends if node.state == state]
        possible = {self._intention(turn, node) for node in nodes}
        if nodes and told not in possible:
            yield turn.fault("reason", f"intends {told}, has to: {' or '.join(map(str, possible))}")
        elif nodes and self.joint:
            yield from self._better(turn, told)
        if decision.believes_goal != turn.holds(state):
            yield turn.fault("reason", f"believes_goal is {decision.believes_goal}")
        if told[0] == "start":
            yield from plan_faults(turn, state, is_first=not self.joint)
            yield from self._start(turn)
        elif told[0] == "stop":
            yield from self._stop(turn, nodes)
        elif told[0] == "give up":
            yield from no_plan_faults(turn, state)
        if trace.plans != len(self.plans):
            yield turn.fault("reason", f"{trace.plans} activities, there are {len(self.plans)}")

    def _told(self, turn: Turn) -> tuple[str, str]:
        """The kind of the intention, with the action if it is physical."""
        decision, trace = turn.decision, turn.decision.trace
        if decision.action == "finish":
            return ("finish" if decision.believes_goal else "give up"), ""
        if trace.mental is not None:
            return str(trace.mental.name), ""
        return "go on", str(decision.action)

    def _intention(self, turn: Turn, node: Node) -> tuple[str, str]:
        """What there is to intend at a node (32)-(53)."""
        if turn.holds(node.state):
            return "finish", ""
        if self.active:
            left = self.plans[self.active - 1][node.done :]
            return ("go on", left[0]) if reaches(turn, node.state, left) else ("stop", "")
        least = turn.office.distances(turn.told.rules.goal).get(node.state)
        return ("give up" if least is None or least > turn.plan_limit else "start"), ""

    def _better(self, turn: Turn, told: tuple[str, str]) -> Iterator[Fault]:
        """Of all smallest explanations none makes a better intention possible."""
        ranks = ("go on", "finish", "stop") if self.active else ("finish", "start", "give up")
        nodes = turn.search.ends(turn.adopted.price)
        best = min((self._intention(turn, n) for n in nodes), key=lambda x: ranks.index(x[0]))
        if ranks.index(best[0]) < ranks.index(told[0]):
            yield turn.fault("reason", f"intends {told}; under another explanation: {best}")
        if told[0] == "start":
            every = turn.office.distances(turn.told.rules.goal)
            least = min(every.get(node.state, turn.plan_limit) for node in nodes)
            if least < len(turn.decision.trace.plan):
                yield turn.fault("plan", f"one of {least} actions may reach the goal")

    def _start(self, turn: Turn) -> Iterator[Fault]:
        """An activity has a new name, unless an earlier one has its plan (28), (42)."""
        trace, plan = turn.decision.trace, tuple(map(str, turn.decision.trace.plan))
        if plan not in self.plans:
            self.plans.append(plan)
        self.active = self.plans.index(plan) + 1
        if str(trace.mental) != f"start({self.active})":
            yield turn.fault("reason", f"{trace.mental}; its name is {self.active}")

    def _stop(self, turn: Turn, nodes: Sequence[Node]) -> Iterator[Fault]:
        """It is stopped because the rest of its plan breaks, where the trace says so, and why."""
        trace, plan = turn.decision.trace, self.plans[self.active - 1] if self.active else ()
        if str(trace.mental) != f"stop({self.active})":
            yield turn.fault("reason", f"{trace.mental}; active is {self.active}")
        self.active = 0
        ways = [(node.state, plan[max(node.done, 0) :]) for node in nodes]
        broken = [broken_at(turn, state, left) for state, left in ways]
        if ways and trace.futile_at not in [turn.step + n for n in broken if n is not None]:
            yield turn.fault("reason", f"futile at {trace.futile_at}; breaks after {broken}")
        told = _IMPOSSIBLE.fullmatch(str(trace.reason))
        if told is not None and told[2]:
            yield from _hindrance_faults(turn, told[1], _COMMA.split(told[2]))


def _hindrance_faults(turn: Turn, action: str, literals: Sequence[str]) -> Iterator[Fault]:
    """A smallest set of literals that make an action impossible."""

    def hinder(some: Sequence[str]) -> bool:
        states = (state for state in turn.office.states if turn.office.agrees(state, some))
        return not any(turn.office.possible(state, action) for state in states)

    fewer = ([x for x in literals if x != each] for each in literals)
    if not hinder(literals) or any(map(hinder, fewer)):
        yield turn.fault("reason", f"{literals} are no smallest hindrance of {action}")


@dataclass
class PlanInHand:
    """The plan that a traditional robot carries out; None: it has to make one."""

    rest: Plan | None = None
    is_given_up: bool = False

    def faults(self, turn: Turn) -> Iterator[Fault]:
        """Of a decision; it is then part of what is known."""
        decision, trace = turn.decision, turn.decision.trace
        self.reconsider(turn)
        is_new, plan = bool(trace.belief), tuple(map(str, trace.plan))
        if is_new != (self.rest is None):
            yield turn.fault("reason", f"a new plan is made: {is_new}")
        if is_new and turn.state is not None:
            self.is_given_up = not plan and not turn.holds(turn.state)
            if self.is_given_up:
                yield from no_plan_faults(turn, turn.state)
            elif plan:
                yield from plan_faults(turn, turn.state)
        elif self.rest is not None and plan != self.rest:
            yield turn.fault("plan", f"carries out {plan}; left of its plan is {self.rest}")
        if str(decision.action) != (plan[0] if plan else "finish"):
            yield turn.fault("reason", f"attempts {decision.action} by the plan {plan}")
        if decision.believes_goal != (not plan and not self.is_given_up):
            yield turn.fault("reason", f"believes_goal is {decision.believes_goal}")
        self.rest = plan[1:]

    def reconsider(self, turn: Turn) -> None:
        """The plan is dropped where an action failed, or the robot explains anew."""
        explains = turn.adopted != turn.before or turn.is_completed
        if explains or turn.percept.happened is False:
            self.rest = None
