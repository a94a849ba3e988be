"""The game itself, without PettingZoo: one robot and one adversary, step by step.

Steps are those of the robot's history (D 2.3): 0 is the selection of the goal, which changes
nothing in the world, so that a game begins at step 1, at which the robot gives its first answer.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeAlias

import numpy as np

from asp.language import Action, Literal
from testbed.environment.allowance import Allowance, Left
from testbed.environment.execution import Execution, Played
from testbed.environment.legality import LegalEvents, Legality
from testbed.environment.payoff import Payoff
from testbed.environment.rules import Ending, IllegalActionError, NotResetError, Rules, Situation
from testbed.protocol import FINISH, NONE, WAIT, Percept
from testbed.search import Pose, Reach, as_it_is
from testbed.world import World

Snapshot: TypeAlias = tuple[Situation, Any]
"""A situation with the state of the random generator: all that a game's future depends on."""
Draw: TypeAlias = Callable[[np.random.Generator], int]
"""Draws the state in which a game begins."""
DrawGoal: TypeAlias = Callable[[int, np.random.Generator], tuple[Literal, ...]]
"""Draws the goal of a game that begins in a state."""


class Core:
    """A game in a world under rules; `initial` are the states that it may begin in, or a draw.

    `execution` says how the robot's attempts come out; by default what is possible takes effect.
    A game has the goal of the rules unless `draw_goal` draws one for it. `pose` gives what the
    searches of the rules look at; by default that is the world itself. Where a game is
    played by tables, `now` is the last moment at which the core was asked, and `catch_up` plays it
    on from there; `situation` is the present one.
    Raises UnknownFluentError if the goal is not of the domain, ValueError for rules that are not.
    """

    def __init__(
        self,
        world: World,
        rules: Rules,
        initial: Sequence[int] | Draw,
        execution: Execution | None = None,
        draw_goal: DrawGoal | None = None,
        pose: Pose | None = None,
    ) -> None:
        world.satisfies(0, rules.goal)
        self.world = world
        self.rules = rules
        self.initial = initial
        self.draw_goal = draw_goal
        self.execution = execution or Execution(world, world.description.robots[0])
        self.robot = self.execution.robot
        self.robot_actions = (WAIT, FINISH, *self.execution.actions)
        self.adversary_actions = (NONE, *world.exogenous_actions)
        self.allowance = Allowance(rules.adversary, world.description)
        posed = pose or partial(as_it_is, world)
        self._payoff = Payoff(rules, posed, world.description.costs)
        self._reach = Reach(posed, rules.search_states)
        self.legality = Legality(
            self.execution, rules, self.adversary_actions, self.allowance, self._reach
        )
        self._random = np.random.default_rng()
        self.now: Situation | None = None
        self.catch_up: Callable[[], None] | None = None

    @property
    def situation(self) -> Situation:
        """The moment of the game. Raises NotResetError before the first game."""
        if self.catch_up is not None:
            catch_up, self.catch_up = self.catch_up, None
            catch_up()
        if self.now is None:
            raise NotResetError
        return self.now

    @property
    def random_state(self) -> Any:
        """The state of the random generator, which can be set."""
        return self._random.bit_generator.state

    @random_state.setter
    def random_state(self, state: Any) -> None:
        self._random.bit_generator.state = state

    def reset(
        self, seed: int | None = None, initial: Sequence[Literal] | None = None, trial: str = ""
    ) -> None:
        """Begins a game in the state of the given literals, or in one drawn from `initial`.

        Without a seed the generator goes on where it was. Raises StateError.
        """
        given = None if initial is None else self.world.state(initial)
        if seed is not None:
            self._random = np.random.default_rng(seed)
        if given is not None:
            state = given
        elif callable(self.initial):
            state = self.initial(self._random)
        else:
            state = self.draw(self.initial)
        goal = self.draw_goal(state, self._random) if self.draw_goal else self.rules.goal
        self.catch_up = None
        self.now = Situation(
            trial=trial,
            step=1,
            state=state,
            goal=goal,
            start=state,
            in_reach=self._stays_in_reach(state, goal),
        )

    def snapshot(self) -> Snapshot:
        """What `restore` needs to play on from here, as often as wanted, in the same way."""
        return self.situation, self.random_state

    def restore(self, snapshot: Snapshot) -> None:
        """Goes back to where the snapshot was taken, in this or an equal core."""
        self.catch_up = None
        self.now, self.random_state = snapshot

    @property
    def achieved(self) -> bool:
        """Whether the goal holds, as opposed to what the robot believes."""
        return self.world.satisfies(self.situation.state, self.situation.goal)

    @property
    def left(self) -> Left:
        """What is left to the adversary of its budget, and of its cooldown."""
        return self.allowance.left(self.situation)

    @property
    def rewards(self) -> dict[str, float]:
        """What the last step was worth to each agent."""
        return self._payoff(self.situation)

    def rewards_of_illegal(self, agent: str) -> dict[str, float]:
        """What it is worth to each agent that an illegal answer of this one ends the game now."""
        return self._payoff.of_illegal(self.situation, agent)

    @property
    def visible(self) -> tuple[Literal, ...]:
        """The literals that the robot is shown now, by its action and by what it always sees."""
        return (*self.situation.sensed, *self.execution.visible(self.situation.state))

    @property
    def percept(self) -> Percept:
        """What the robot is told before its next answer."""
        now = self.situation
        attempted = now.happened is not None
        return Percept(
            trial=now.trial,
            step=now.step,
            visible=[*map(Literal.parse, self.visible)],
            attempted=Literal.parse(now.answer) if attempted and now.answer else None,
            happened=now.happened,
            events=list(now.told),
            goal_holds=now.goal_holds,
        )

    def events(self, robot_action: Action | None) -> tuple[Action, ...]:
        """What the adversary may do beside the robot's action: `none`, then exogenous actions.

        Not knowing it (None), the adversary may try all that is possible by itself.
        """
        return tuple(self.legal_events(robot_action))

    def legal_events(self, robot_action: Action | None) -> LegalEvents:
        """The same, each tested only when it is asked for. Those asked for last are remembered."""
        return self.legality.events(self.situation, robot_action)

    def legal(self, robot_action: Action | None, event: Action) -> bool:
        """Whether `event` is among `events(robot_action)`."""
        return self.legal_events(robot_action).allows(event)

    def is_physical(self, robot_action: Action) -> bool:
        """Whether an action of the robot is to change the world: neither mental nor a test."""
        return robot_action not in (WAIT, FINISH) and bool(self.execution.physical(robot_action))

    def why_not(self, robot_action: Action, event: Action) -> str | None:
        """One line that says why the event is impossible beside the robot's action; else None."""
        return self.legal_events(robot_action).why_not(event)

    def advance(self, robot_action: Action, event: Action = NONE) -> None:
        """Plays a step: both actions at once. An attempt at the impossible changes nothing.

        Raises IllegalActionError, and leaves all as it was, where the game is over, the robot has
        no such action, or the event is not one of `events(robot_action)`.
        """
        self._check(robot_action, event)
        now, execution = self.situation, self.execution
        happened = self._takes_effect(robot_action)
        effective = execution.physical(robot_action) if happened else ()
        compound = effective if event == NONE else (*effective, event)
        state = self.draw(self.world.successors(now.state, compound))
        played = Played(
            execution=execution,
            rules=self.rules.observability,
            random=self._random,
            before=now,
            effective=effective,
            event=None if event == NONE else event,
            after=state,
            possible=self.legal_events(robot_action).possible,
        )
        sensed = execution.sensed(robot_action, state, self._random) if happened else ()
        news = (*now.pending, *played.reports())
        self.now = Situation(
            trial=now.trial,
            step=now.step + 1,
            state=state,
            goal=now.goal,
            answer=robot_action,
            happened=None if robot_action in (WAIT, FINISH) else happened,
            event=event,
            sensed=sensed,
            told=tuple(report for due, report in news if due <= now.step + 1),
            pending=tuple((due, report) for due, report in news if due > now.step + 1),
            goal_holds=False if self._answers(robot_action) else None,
            ending=self._ending(robot_action),
            start=now.start,
            before=now.state,
            played=now.played if event == NONE else (*now.played, (now.step, event)),
            units=now.units + self._payoff.costs.get(robot_action, 0),
            in_reach=now.in_reach and self._stays_in_reach(state, now.goal),
        )

    def _stays_in_reach(self, state: int, goal: tuple[Literal, ...]) -> bool:
        """Whether the goal is within reach, as far as the rewards ask."""
        return self.rules.rewards.adversary != "fail" or bool(self._reach(state, goal))

    def draw(self, states: Sequence[int]) -> int:
        """One of several states, or positions; of a single one nothing is drawn."""
        return states[int(self._random.integers(len(states)))] if len(states) > 1 else states[0]

    def _check(self, robot_action: Action, event: Action) -> None:
        if self.situation.ending is not None:
            raise IllegalActionError(f"the game is over: {self.situation.ending}")
        if robot_action not in self.robot_actions:
            raise IllegalActionError(f"{robot_action} is not an action of the robot")
        if event not in self.adversary_actions:
            raise IllegalActionError(f"{event} is not an action of the adversary")
        reason = self.why_not(robot_action, event)
        if reason is not None:
            step = self.situation.step
            raise IllegalActionError(f"step {step}: {event} beside {robot_action}: {reason}")

    def _takes_effect(self, robot_action: Action) -> bool:
        chance = self.execution.chance(robot_action)
        possible = self.execution.possible(self.situation.state, robot_action)
        return possible and (chance >= 1 or bool(self._random.random() < chance))

    def _answers(self, robot_action: Action) -> bool:
        """Whether this is a wrong `finish` to which the game goes on."""
        told_before = self.situation.goal_holds is False
        wrong = robot_action == FINISH and not self.achieved
        return wrong and self.rules.goal_feedback and not told_before

    def _ending(self, robot_action: Action) -> Ending | None:
        if robot_action == FINISH and self.achieved:
            return Ending.ACHIEVED
        if robot_action == FINISH and not self._answers(robot_action):
            return Ending.FALSE_FINISH
        return Ending.STEP_LIMIT if self.situation.step >= self.rules.steps else None
