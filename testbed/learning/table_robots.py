"""Robots whose answer depends on the true state alone: tables that are given, or made by search."""

from collections.abc import Mapping
from operator import index
from typing import Any, TypeAlias

from testbed.config import ConfigError
from testbed.environment import Core
from testbed.protocol import FINISH, WAIT, RobotLost
from testbed.search import BudgetError, cheapest_plan
from testbed.world import World

CHEAPEST = "cheapest"
"""The table robot that follows cheapest plans."""
Table: TypeAlias = Mapping[int, int]
"""By state of the world, as the worlds of `testbed.world` have it, the number of an action."""


def is_table(robot: str | Table) -> bool:
    """Whether this is a robot that plays from a table."""
    return isinstance(robot, Mapping) or (isinstance(robot, str) and robot == CHEAPEST)


def table_of(robot: str | Table, core: Core) -> Table:
    """The table that a robot plays from; asked for a state that it lacks, it raises RobotLost.

    Raises ConfigError for a given table that does not lead from states to actions of the robot.
    """
    return GivenTable(robot, core) if isinstance(robot, Mapping) else CheapestPlans(core)


class GivenTable(dict[int, int]):
    """A table that was given. Raises as `table_of`."""

    def __init__(self, table: Table, core: Core) -> None:
        super().__init__(_whole(*entry) for entry in table.items())
        self._world = core.world
        for state, own in self.items():
            if not 0 <= own < len(core.robot_actions):
                most = len(core.robot_actions) - 1
                raise _bad(
                    f"state {state}: {own!r} is not an action; give a number from 0 to {most}"
                )

    def __missing__(self, state: int) -> int:
        raise RobotLost(f"its table has no action for the state {_told(self._world, state)}")


class CheapestPlans(dict[int, int]):
    """The first action of a cheapest plan from each state: an optimal planner that sees everything.

    A plan is the cheaper the fewer execution units it takes, then the fewer actions, so that each
    step of it leads nearer to the goal. Where the goal holds the robot finishes; where no plan
    achieves it, it waits. Of several outcomes of an action it counts on the best. Found when it is
    asked for; a search looks at `limits.judge_states` states at most.
    """

    def __init__(self, core: Core) -> None:
        super().__init__()
        self._core = core
        factor, units = core.rules.steps + 1, core.world.description.costs
        actions = core.world.agent_actions
        self._prices: dict[str, int] = {own: units.get(own, 0) * factor + 1 for own in actions}
        self._numbers: dict[str, int] = {own: n for n, own in enumerate(core.robot_actions)}

    def __missing__(self, state: int) -> int:
        self[state] = self._numbers[self._first(state)]
        return self[state]

    def _first(self, state: int) -> str:
        world, rules = self._core.world, self._core.rules
        try:
            plan = cheapest_plan((world, state, rules.goal), self._prices, rules.search_states)
        except BudgetError as error:
            told = _told(world, state)
            raise RobotLost(f"no plan found from {told}: {error} (limits.judge_states)") from None
        if plan is None:
            return WAIT
        return plan[0] if plan else FINISH


def _whole(state: Any, action: Any) -> tuple[int, int]:
    try:
        return index(state), index(action)
    except TypeError:
        raise _bad(f"{state!r}: {action!r} should be a state and the number of an action") from None


def _bad(what: str) -> ConfigError:
    return ConfigError([f"keyword argument: robot: {what}"])


def _told(world: World, state: int) -> str:
    return ", ".join(map(str, world.true_atoms(state))) or "in which nothing is true"
