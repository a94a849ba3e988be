"""A robot that decides at the coarse resolution and acts at the fine one (P 3.3)."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

from msgspec import structs

from agents.intentional.abstraction import AbstractingRobot
from agents.intentional.controller import IntentionalRobot
from agents.intentional.executor.belief import Mind
from agents.intentional.executor.coarse import CoarseDiagram, Outcome, Reporter
from agents.intentional.executor.execution import Execution, Steps
from agents.intentional.executor.trace import Calendar
from asp.language import Literal, is_positive
from asp.refinement import load
from asp.solving import State, deciding, preparation, reasoning_clock
from testbed.protocol import Capabilities, Decision, Percept, Robot, Task, Trace

_WAIT, _FINISH = "wait", "finish"


class RefinedRobot:
    """Carries out the abstract actions of a coarse robot in cells and parts.

    `coarse` makes the robot that decides; with `zooms` concrete plans are made in the part of the
    refined description that is relevant to the action and the goal, else in all of it.
    """

    def __init__(self, coarse: Callable[[], Robot] = IntentionalRobot, zooms: bool = True) -> None:
        self._coarse = AbstractingRobot(coarse())
        self._zooms = zooms

    def begin(self, task: Task) -> None:
        """Takes the task on; what this takes beside preparation counts as planning.

        Raises SourceError for the task's texts.
        """
        with deciding():
            self._take_on(task)

    def _take_on(self, task: Task) -> None:
        began = reasoning_clock()
        with preparation():
            file = f"{task.domain}.al"
            refinement = load(task.source, file, task.refinement, f"{task.domain}.fine")
        self._coarse.begin(structs.replace(task, refinement="", initial_fine=[]))
        self._diagram = CoarseDiagram(self._coarse.abstract)
        self._mind = Mind(refinement, self._diagram.robot, task, self._zooms)
        known = [literal for literal in task.initial if self._coarse.abstract.is_about(literal)]
        self._mind.know(task.initial_fine, known)
        self._calendar = Calendar()
        self._reporter = Reporter(self._mind, self._diagram, self._calendar)
        self._believed: State = frozenset(filter(is_positive, known))
        self._execution: Execution | None = None
        self._steps: Steps | None = None
        self._outcome: Outcome | None = None
        spent = reasoning_clock().since(began)
        self._mind.tally.spend("planning", spent)
        self._prepared = spent.preparation_cpu

    def act(self, percept: Percept) -> Decision:
        """The next concrete action. Raises RobotStops."""
        with deciding() as limited:
            began, prepared = reasoning_clock(), self._prepared
            decision = self._next(percept)
            self._prepared = 0.0
            spent = prepared + reasoning_clock().since(began).preparation_cpu
        trace = structs.replace(decision.trace, preparation_cpu_s=spent, deadline=limited.late)
        return structs.replace(decision, trace=trace)

    def _next(self, percept: Percept) -> Decision:
        if self._steps is None:
            self._mind.hear(percept)
            return self._decide(percept)
        action = self._advance(percept)
        return self._decide(percept) if action is None else self._concrete(percept, action)

    def _advance(self, percept: Percept | None) -> str | None:
        """The next concrete action of the abstract one; None if it is over."""
        execution = self._execution
        assert execution is not None
        assert self._steps is not None
        try:
            return next(self._steps) if percept is None else self._steps.send(percept)
        except StopIteration as stop:
            self._outcome = Outcome(execution.action, bool(stop.value), execution.effects)
            self._steps = None
            return None

    def _decide(self, percept: Percept) -> Decision:
        """What the coarse robot decides, with what it is told of the last abstract action."""
        outcome, self._outcome = self._outcome, None
        told, expected = self._reporter.percept(percept, self._believed, outcome)
        if outcome is not None:
            inferred = [*self._reporter.inferred(outcome), *told.visible]
            self._mind.tally.end(outcome.happened, inferred)
        decision = self._ask(percept, told)
        self._believe(expected, decision)
        trace = self._calendar.trace(decision.trace)
        decision = structs.replace(decision, step=percept.step, trace=trace)
        if decision.action in (_WAIT, _FINISH):
            return self._with_trace(decision)
        return self._begin(percept, decision)

    def _ask(self, percept: Percept, told: Percept) -> Decision:
        """The coarse robot's decision.

        That the goal does not hold it is told a coarse step after what it saw before: in between
        something may have happened.
        """
        self._calendar.begin(percept.step)
        decision = self._coarse.act(structs.replace(told, goal_holds=None))
        if told.goal_holds is None or decision.action != _FINISH:
            return decision
        self._calendar.begin(percept.step)
        step = self._calendar.step
        return self._coarse.act(
            Percept(trial=told.trial, step=step, visible=[], goal_holds=told.goal_holds)
        )

    def _believe(self, expected: State, decision: Decision) -> None:
        """What is believed now; what was known to the contrary at the fine resolution is old."""
        belief = decision.trace.belief
        self._believed = frozenset(belief) if belief else expected
        fluents = [f for f in self._diagram.fluents if self._mind.is_magnified(f)]
        with self._mind.tally.timing("infer"):
            self._mind.belief.adapt(expected, self._believed, fluents)
        self._mind.agree(self._believed, self._diagram.fluents)

    def _begin(self, percept: Percept, decision: Decision) -> Decision:
        """Begins the abstract action that was decided."""
        action, believed = decision.action, self._believed
        self._execution = Execution(self._mind, self._diagram, action, believed, percept.step)
        self._steps = self._execution.run()
        first = self._advance(None)
        return self._with_trace(structs.replace(decision, action=first or _WAIT))

    def _concrete(self, percept: Percept, action: str) -> Decision:
        """A decision in the middle of an abstract action."""
        decision = Decision(
            trial=percept.trial,
            step=percept.step,
            action=Literal.parse(action),
            believes_goal=False,
            trace=Trace(),
        )
        return self._with_trace(decision)

    def _with_trace(self, decision: Decision) -> Decision:
        trace = structs.replace(decision.trace, fine=self._mind.tally.take())
        return structs.replace(decision, trace=trace)


class EitherRobot:
    """Acts at the fine resolution if its task has one, else as the coarse robot does."""

    capabilities: ClassVar = Capabilities(
        resolutions=("coarse", "fine"), knowledge=("complete", "seen"), first_action_step=2
    )

    def __init__(self, coarse: Callable[[], Robot] = IntentionalRobot, zooms: bool = True) -> None:
        self._make = coarse
        self._zooms = zooms

    def begin(self, task: Task) -> None:
        """Takes the task on. Raises SourceError for its texts."""
        self._robot = RefinedRobot(self._make, self._zooms) if task.refinement else self._make()
        self._robot.begin(task)

    def act(self, percept: Percept) -> Decision:
        """The robot's decision. Raises RobotStops."""
        return self._robot.act(percept)
