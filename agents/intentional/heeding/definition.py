"""What is relevant to the action at hand or to the goal, by Definition 1 (P 3.3)."""

from collections.abc import Iterable

from agents.intentional.heeding.laws import laws_of
from agents.intentional.heeding.scene import Scene
from agents.shared import sessions_of
from asp.language import Fluent, Literal
from asp.reasoning import knowledge
from asp.refinement import Transition, relevant
from asp.solving import State
from testbed.protocol import Task


class Definition:
    """Heeds what is about relevant constants only, or may change a fluent of the goal.

    The constants are those of relCon(T, G), where T is the transition by the action at hand; of a
    function its value need not be one of them. A fluent of the goal is changed through state
    constraints and definitions, one after another.
    """

    def __init__(self, task: Task) -> None:
        self._goal = tuple(task.goal)
        self._knowledge = knowledge(task.domain, task.source)
        self._laws = laws_of(task.domain, task.source)
        self._bearing = self._laws.bearing_on(literal.atom for literal in self._goal)
        self._constants_of_goal = relevant(self._laws.coarse, None, self._goal)

    def heeded(self, scene: Scene, /) -> Iterable[Literal]:
        # The goal's constants are always relevant: mostly they are enough, and nothing is solved.
        left = [each for each in scene.visible if not self._is_for_goal(each.atom)]
        constants = self._constants(scene) if left else ()
        ignored = {each for each in left if not self._laws.is_about(each.atom, constants)}
        return [literal for literal in scene.visible if literal not in ignored]

    def _is_for_goal(self, fluent: Fluent) -> bool:
        return fluent in self._bearing or self._laws.is_about(fluent, self._constants_of_goal)

    def _constants(self, scene: Scene) -> frozenset[str]:
        """relCon(T, G); where the action may come out in several ways, for each of them."""
        domain, before, action = self._laws.coarse, scene.believed, scene.action
        if action is None:
            return self._constants_of_goal
        transitions = (Transition(before, action, after) for after in self._expected(scene))
        return frozenset[str]().union(*(relevant(domain, each, self._goal) for each in transitions))

    def _expected(self, scene: Scene) -> Iterable[State]:
        """The states to which the action at hand may lead; where none is found, that before it."""
        assert scene.action is not None
        transitions = sessions_of(self._knowledge).transitions
        return transitions.outcomes(scene.believed, {scene.action}) or {scene.believed}
