"""What is relevant by Definition 1, and what the rest of the plan depends on."""

from collections.abc import Iterable

from agents.intentional.heeding.definition import Definition
from agents.intentional.heeding.laws import laws_of
from agents.intentional.heeding.scene import Scene
from asp.language import Literal
from testbed.protocol import Task


class Plan:
    """Heeds, beside what is relevant by definition, the conditions of the rest of the activity.

    These are the conditions on its actions and on their effects, and what may change one through
    state constraints and definitions: a lock on the way, a helper who has to be there.
    """

    def __init__(self, task: Task) -> None:
        self._definition = Definition(task)
        self._laws = laws_of(task.domain, task.source)

    def heeded(self, scene: Scene, /) -> Iterable[Literal]:
        bearing = self._laws.bearing_on(self._laws.conditions(scene.rest))
        ahead = (literal for literal in scene.visible if literal.atom in bearing)
        return [*self._definition.heeded(scene), *ahead]
