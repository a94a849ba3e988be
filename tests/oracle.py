"""The least that achieves a goal, as the judge of trials finds it."""

from collections.abc import Iterable, Mapping

from testbed.search import cheapest_plan
from testbed.world import World


def minimal_actions(world: World, state: int, goal: Iterable[str]) -> int | None:
    """The length of a shortest plan, None where there is none."""
    plan = cheapest_plan((world, state, goal))
    return None if plan is None else len(plan)


def minimal_units(
    world: World, state: int, goal: Iterable[str], costs: Mapping[str, int]
) -> int | None:
    """The execution units of a cheapest plan, None where there is none."""
    plan = cheapest_plan((world, state, goal), costs)
    return None if plan is None else sum(costs.get(action, 0) for action in plan)
