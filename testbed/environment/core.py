"""The game itself, without PettingZoo: one robot and one adversary, step by step.

Steps are those of the robot's history (D 2.3): 0 is the selection of the goal, which changes
nothing in the world, so that a game begins at step 1, at which the robot gives its first answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from gymnasium.utils import seeding

from asp import literals as text
from testbed.environment.errors import IllegalActionError
from testbed.environment.rules import Observability, Rules
from testbed.environment.situation import Ending, Situation, Snapshot
from testbed.environment.world import World
from testbed.link.messages import Event, Percept

WAIT, FINISH, NONE = "wait", "finish", "none"
"""The actions that are the environment's own: of the robot, and of the adversary."""


class Core:
    """A game in a world under rules; `initial` are the states that it may begin in.

    Raises UnknownFluentError if the goal is not of the domain.
    """

    situation: Situation

    def __init__(self, world: World, rules: Rules, initial: Sequence[int]) -> None:
        world.satisfies(0, rules.goal)
        self.world = world
        self.rules = rules
        self.initial = initial
        self.robot = world.description.robots[0]
        self.robot_actions = (WAIT, FINISH, *world.agent_actions)
        self.adversary_actions = (NONE, *world.exogenous_actions)
        self._random: np.random.Generator | None = None

    def reset(
        self, seed: int | None = None, initial: Sequence[str] | None = None, trial: str = ""
    ) -> None:
        """Begins a game in the state of the given literals, or in one drawn from `initial`.

        Without a seed the generator goes on where it was. Raises StateError.
        """
        if seed is not None or self._random is None:
            self._random, _ = seeding.np_random(seed)
        state = self._draw(self.initial) if initial is None else self.world.state(initial)
        self.situation = Situation(trial=trial, step=1, state=state)

    def snapshot(self) -> Snapshot:
        """What `restore` needs to play on from here, as often as wanted, in the same way."""
        return Snapshot(self.situation, self._generator.bit_generator.state)

    def restore(self, snapshot: Snapshot) -> None:
        """Goes back to where the snapshot was taken, in this or an equal core."""
        if self._random is None:
            self._random, _ = seeding.np_random(0)
        self.situation = snapshot.situation
        self._random.bit_generator.state = snapshot.generator

    @property
    def achieved(self) -> bool:
        """Whether the goal holds, as opposed to what the robot believes."""
        return self.world.satisfies(self.situation.state, self.rules.goal)

    @property
    def percept(self) -> Percept:
        """What the robot is told before its next answer."""
        now = self.situation
        return Percept(
            trial=now.trial,
            step=now.step,
            visible=list(self.world.visible(now.state, self.robot)),
            attempted=None if now.happened is None else now.answer,
            happened=now.happened,
            events=list(now.told),
            goal_holds=now.goal_holds,
        )

    def events(self, robot_action: str | None) -> tuple[str, ...]:
        """What the adversary may do beside the robot's action: `none`, then exogenous actions.

        Not knowing it (None), the adversary may try all that is possible by itself.
        """
        if robot_action == FINISH or (robot_action == WAIT and not self._opens_thinking):
            return (NONE,)
        beside = () if robot_action is None else self._effective(robot_action)
        executable, state = self.world.executable, self.situation.state
        return (NONE, *(e for e in self.world.exogenous_actions if executable(state, (*beside, e))))

    def why_not(self, robot_action: str, event: str) -> str | None:
        """One line that says why the event is impossible beside the robot's action; else None."""
        if event in self.events(robot_action):
            return None
        if robot_action == FINISH:
            return "nothing exogenous happens while the robot finishes"
        if robot_action == WAIT and not self._opens_thinking:
            return "nothing exogenous happens while the robot waits (exogenous_while_thinking)"
        compound = (*self._effective(robot_action), event)
        return self.world.why_not(self.situation.state, compound)

    def advance(self, robot_action: str, event: str = NONE) -> None:
        """Plays a step: both actions at once. An attempt at the impossible changes nothing.

        Raises IllegalActionError, and leaves all as it was, where the game is over, the robot has
        no such action, or the event is not one of `events(robot_action)`.
        """
        self._check(robot_action, event)
        effective = self._effective(robot_action)
        state = self._outcome(effective, event)
        step = self.situation.step + 1
        news = (*self.situation.pending, *self._news(robot_action, event, state))
        self.situation = Situation(
            trial=self.situation.trial,
            step=step,
            state=state,
            answer=robot_action,
            happened=None if robot_action in (WAIT, FINISH) else bool(effective),
            event=event,
            told=tuple(report for due, report in news if due <= step),
            pending=tuple((due, report) for due, report in news if due > step),
            goal_holds=False if self._answers(robot_action) else None,
            ending=self._ending(robot_action),
        )

    @property
    def _opens_thinking(self) -> bool:
        return self.rules.exogenous_while_thinking

    @property
    def _generator(self) -> np.random.Generator:
        if self._random is None:
            raise RuntimeError("the environment must be reset first")
        return self._random

    def _draw(self, states: Sequence[int]) -> int:
        if len(states) == 1:
            return states[0]
        return states[int(self._generator.integers(len(states)))]

    def _check(self, robot_action: str, event: str) -> None:
        if self.situation.ending is not None:
            raise IllegalActionError(f"the game is over: {self.situation.ending}")
        if robot_action not in self.robot_actions:
            raise IllegalActionError(f"{robot_action} is not an action of the robot")
        if event != NONE and event not in self.world.exogenous_actions:
            raise IllegalActionError(f"{event} is not an action of the adversary")
        reason = self.why_not(robot_action, event)
        if reason is not None:
            step = self.situation.step
            raise IllegalActionError(f"step {step}: {event} beside {robot_action}: {reason}")

    def _effective(self, robot_action: str) -> tuple[str, ...]:
        """The robot's part of the compound action: nothing if it thinks or tries in vain."""
        if robot_action in (WAIT, FINISH):
            return ()
        possible = self.world.executable(self.situation.state, (robot_action,))
        return (robot_action,) if possible else ()

    def _outcome(self, effective: tuple[str, ...], event: str) -> int:
        compound = effective if event == NONE else (*effective, event)
        return self._draw(self.world.successors(self.situation.state, compound))

    def _news(self, robot_action: str, event: str, after: int) -> Iterator[tuple[int, Event]]:
        """Reports of this step, true and false, with the steps at which they reach the robot."""
        step = self.situation.step
        told = [event] if self._is_told(self._effective(robot_action), event, after) else []
        for action in (*told, *self._false_reports(robot_action, event)):
            late = self.rules.observability[text.name(action)].delay
            yield step + 1 + late, Event(step=step, action=action)

    def _is_told(self, effective: tuple[str, ...], event: str, after: int) -> bool:
        how = self.rules.observability.get(text.name(event), Observability())
        if event == NONE or how.mode == "never":
            return False
        if how.mode == "colocated" and not self._witnessed(effective, after):
            return False
        return bool(self._generator.random() < how.probability)

    def _false_reports(self, robot_action: str, event: str) -> Iterator[str]:
        for name, how in self.rules.observability.items():
            if how.false_reports > 0.0 and self._generator.random() < how.false_reports:
                possible = (e for e in self.events(robot_action) if text.name(e) == name)
                others = [other for other in possible if other != event]
                if others:
                    yield others[int(self._generator.integers(len(others)))]

    def _witnessed(self, effective: tuple[str, ...], after: int) -> bool:
        """Whether the robot sees, before or after, what is as it is because of the event."""
        before = self.situation.state
        alone = self.world.successors(before, effective)
        changed = self.world.true_atoms(after ^ (alone[0] if alone else before))
        seen = self.world.visible(before, self.robot) + self.world.visible(after, self.robot)
        return not set(changed).isdisjoint(map(text.atom, seen))

    def _answers(self, robot_action: str) -> bool:
        """Whether this is a wrong `finish` to which the game goes on."""
        told_before = self.situation.goal_holds is False
        wrong = robot_action == FINISH and not self.achieved
        return wrong and self.rules.goal_feedback and not told_before

    def _ending(self, robot_action: str) -> Ending | None:
        if robot_action == FINISH and self.achieved:
            return Ending.ACHIEVED
        if robot_action == FINISH and not self._answers(robot_action):
            return Ending.FALSE_FINISH
        return Ending.STEP_LIMIT if self.situation.step >= self.rules.steps else None
