"""Principles of a robot that acts in cells and parts: where it is, it knows, and its plans fit.

They are about the robot's own fluents and the map, of which it is never mistaken: tests of what it
is in itself tell the truth. Of things it may believe what is wrong, and plan accordingly.
"""

from collections.abc import Sequence

from asp.language import Action
from testbed.experiment.episodes import Episode
from testbed.stress.mind import Broken


def teleports(episode: Episode) -> Broken:
    """What the robot takes for certain of itself holds: it gets nowhere but by what it does."""
    world, robot = episode.setup.world, episode.setup.robot
    for moment in episode.moments:
        fine = moment.decision.trace.fine
        for literal in fine.committed if fine else ():
            is_fluent = literal.atom in world.fluents
            if robot in literal.arguments and not (
                is_fluent and world.holds(moment.before, literal)
            ):
                told = f"it takes {literal} for certain, and that does not hold"
                yield "teleport", moment.percept.step, told


def plans_that_fit(episode: Episode) -> Broken:
    """No action of a concrete plan is impossible by the robot's own fluents and the map alone."""
    for moment in episode.moments:
        fine = moment.decision.trace.fine
        plan = fine.plan if fine else []
        misfit = _misfit(episode, moment.before, plan)
        if misfit is not None:
            told = f"its plan {' '.join(plan)} does not fit the map at {misfit}"
            yield "off the map", moment.percept.step, told


def _misfit(episode: Episode, state: int, plan: Sequence[Action]) -> Action | None:
    """The first action that cannot be done here, however it is with the things."""
    world, robot = episode.setup.world, episode.setup.robot
    for action in plan:
        if action not in world.agent_actions:
            return action
        bodies = [body for _, body in world.forbidding(state, (action,))]
        if any(all(robot in own.arguments for own in body) for body in bodies):
            return action
        reached = world.successors(state, (action,))
        if len(reached) != 1:  # a thing is in the way: from here on the robot believes otherwise
            return None
        state = reached[0]
    return None
