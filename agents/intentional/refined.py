"""A robot that decides at the coarse resolution and acts at the fine one (P 3.3)."""

from copy import copy
from dataclasses import replace
from typing import ClassVar, Self, TypeAlias

from msgspec import structs

from agents.intentional.abstraction import AbstractTask
from agents.intentional.controller import IntentionalRobot
from agents.intentional.executor.belief import FineTracker
from agents.intentional.executor.coarse import Reporter
from agents.intentional.executor.undertaking import Undertaking
from agents.intentional.programs import Watcher
from agents.shared import retold
from asp.refinement import load
from asp.solving import State, deciding, preparation, reasoning_clock
from testbed.protocol import FINISH, WAIT, Capabilities, Decision, Percept, Robot, Task, Trace


class RefinedRobot:
    """Carries out the abstract actions of a coarse robot in cells and parts.

    `coarse` is the robot that decides; with `zooms` concrete plans are made in the part of the
    refined description that is relevant to the action and the goal, else in all of it.
    """

    def __init__(self, coarse: Robot, zooms: bool = True) -> None:
        self._coarse = coarse
        self._zooms = zooms

    def begin(self, task: Task) -> None:
        """Takes the task on; what this takes beside preparation counts as planning.

        Raises SourceError for the task's texts.
        """
        with deciding():
            began = reasoning_clock()
            with preparation():
                file = f"{task.domain}.al"
                refinement = load(task.source, file, task.refinement, f"{task.domain}.fine")
            abstract = self._abstract = AbstractTask(
                structs.replace(task, refinement="", initial_fine=[])
            )
            self._coarse.begin(abstract.task)
            self._fine = FineTracker(refinement, abstract.robot, task, self._zooms)
            known = [literal for literal in task.initial if abstract.is_about(literal)]
            self._fine.know(task.initial_fine, known)
            self._reporter = Reporter(self._fine, abstract)
            self._believed: State = frozenset(each for each in known if each.is_positive)
            self._undertaking: Undertaking | None = None
            spent = reasoning_clock().since(began)
            self._fine.trace.spend("planning", spent)
            self._prepared = spent.preparation_cpu

    def act(self, percept: Percept) -> Decision:
        """The next concrete action. Raises RobotStops."""
        with deciding() as limited:
            began, prepared = reasoning_clock(), self._prepared
            decision = self._next(percept)
            self._prepared = 0.0
            spent = prepared + reasoning_clock().since(began).preparation_cpu
        trace = structs.replace(
            decision.trace,
            fine=self._fine.trace.take(),
            preparation_cpu_s=spent,
            deadline=limited.late,
        )
        return structs.replace(decision, trace=trace)

    def snapshot(self) -> Self:
        """A twin that stays as this robot is now; `coarse` is an intentional robot."""
        assert isinstance(self._coarse, IntentionalRobot)
        twin = copy(self)
        twin._coarse = self._coarse.snapshot()
        fine = twin._fine = self._fine.copy()
        twin._reporter = self._reporter.copy(fine)
        twin._undertaking = self._undertaking and self._undertaking.copy(fine)
        return twin

    def _next(self, percept: Percept) -> Decision:
        """A decision in the middle of an abstract action; where none is carried out, of one."""
        own = self._undertaking
        if own is None or own.is_over:
            self._fine.hear(percept)
            return self._decide(percept)
        action = own.next(percept)
        if action is None:
            return self._decide(percept)
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=action,
            believes_goal=False,
            trace=Trace(),
        )

    def _decide(self, percept: Percept) -> Decision:
        """What the coarse robot decides, with what it is told of the abstract action before.

        An abstract action is begun; where nothing needs to be done for it the robot waits a step.
        """
        over = None if self._undertaking is None else self._undertaking.execution
        self._undertaking = None
        told, expected = self._reporter.percept(percept, self._believed, over)
        if over is not None:
            effects = filter(self._fine.is_magnified, self._fine.holding(over.effects))
            inferred, happened = sorted([*effects, *told.visible]), over.happened
            self._fine.trace.note(
                abstract=None, begun=None, ended=over.action, happened=happened, inferred=inferred
            )
        decision = self._ask(percept, told)
        action, belief = decision.action, decision.trace.belief
        self._believed = frozenset(belief) if belief else expected
        self._fine.agree(expected, self._believed, self._abstract.fluents)
        if action not in (WAIT, FINISH):
            self._undertaking = Undertaking(
                self._fine, self._abstract, action, self._believed, percept.step
            )
            action = self._undertaking.first() or WAIT
        trace = retold(decision.trace, step=self._reporter.own)
        return structs.replace(decision, step=percept.step, trace=trace, action=action)

    def _ask(self, percept: Percept, told: Percept) -> Decision:
        """The coarse robot's decision.

        That the goal does not hold it is told a coarse step after what it saw before: in between
        something may have happened.
        """
        decision = self._answer(percept.step, structs.replace(told, goal_holds=None))
        if told.goal_holds is None or decision.action != FINISH:
            return decision
        last = Percept(trial=told.trial, step=told.step + 1, visible=[], goal_holds=told.goal_holds)
        return self._answer(percept.step, last)

    def _answer(self, step: int, told: Percept) -> Decision:
        """The coarse robot's answer; the coarse step begins at a step of the environment."""
        self._reporter.begin(step)
        return self._abstract.decision(self._coarse.act(self._abstract.percept(told)))


Snapshot: TypeAlias = RefinedRobot | IntentionalRobot


class EitherRobot:
    """Acts at the fine resolution if its task has one, else as `IntentionalRobot` does."""

    capabilities: ClassVar = Capabilities(
        resolutions=("coarse", "fine"),
        knowledge=("complete", "seen"),
        plans=("optimistic", "conformant"),
        first_action_step=2,
        snapshots=True,
    )
    watcher: Watcher | None = None
    """As of `IntentionalRobot`; at the fine resolution it is told coarse decisions."""
    _zooms: ClassVar = True

    def begin(self, task: Task) -> None:
        """Takes the task on. Raises SourceError for its texts."""
        coarse = IntentionalRobot()
        coarse.watcher = self.watcher
        self._robot: Snapshot = RefinedRobot(coarse, self._zooms) if task.refinement else coarse
        self._robot.begin(task)

    def act(self, percept: Percept) -> Decision:
        """The robot's decision. Raises RobotStops."""
        return self._robot.act(percept)

    def snapshot(self) -> Snapshot:
        """The robot as it is now, at the resolution of its task."""
        return self._robot.snapshot()

    def restore(self, snapshot: Snapshot) -> None:
        """Becomes as the robot was whose snapshot this is, which may be used again."""
        self._robot = snapshot.snapshot()


class WithoutZooming(EitherRobot):
    """Acts at the fine resolution only, and plans in the whole refined description."""

    capabilities: ClassVar = replace(EitherRobot.capabilities, resolutions=("fine",))
    _zooms: ClassVar = False
