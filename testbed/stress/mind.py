"""What a robot says that it believes at each step, as a state of the world."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from asp.language import Action, Fluent
from testbed.experiment.episodes import Episode
from testbed.experiment.storyteller import Moment
from testbed.world import StateError

Broken = Iterator[tuple[str, int, str]]
"""A rule, the step at which it is broken, and how."""


@dataclass(frozen=True)
class Believed:
    """A step at which the robot tells its belief: its atoms, and the state that they are.

    `state` is None where no state of the domain has just these atoms.
    """

    episode: Episode
    moment: Moment
    atoms: frozenset[Fluent]
    state: int | None

    @property
    def step(self) -> int:
        """The step of the trial."""
        return self.moment.percept.step

    @property
    def believes_goal(self) -> bool:
        """Whether the goal holds, as far as it believes."""
        goal = self.episode.spec.setting.goal
        return all((own.atom in self.atoms) == own.is_positive for own in goal)

    def has_plan(self) -> bool:
        """Whether a plan within the limit achieves the goal from here, as far as is known."""
        setting = self.episode.spec.setting
        if self.state is None:
            return False
        judge = self.episode.setup.judge
        fewest = judge.minimal(self.state, setting.goal, setting.judge_states).actions
        return fewest is not None and fewest <= setting.plan_limit

    def reaches_goal(self, plan: Sequence[Action]) -> bool:
        """Whether some outcomes of a plan lead from here to a state of the goal."""
        world, states = self.episode.setup.world, {self.state}
        if not set(plan).issubset(world.agent_actions):
            return False
        for action in plan:
            states = {
                after
                for state in states
                if state is not None
                for after in world.successors(state, (action,))
            }
        goal = self.episode.spec.setting.goal
        return any(world.satisfies(state, goal) for state in states if state is not None)


def beliefs(episode: Episode) -> list[Believed]:
    """The steps at which the robot tells what it believes."""
    return [
        Believed(episode, moment, frozenset(moment.decision.trace.belief), _state(episode, moment))
        for moment in episode.moments
        if moment.decision.trace.belief
    ]


def _state(episode: Episode, moment: Moment) -> int | None:
    world, atoms = episode.setup.world, frozenset(moment.decision.trace.belief)
    try:
        state = world.state(sorted(atoms))
    except (StateError, KeyError):
        return None
    return state if frozenset(world.true_atoms(state)) == atoms else None
