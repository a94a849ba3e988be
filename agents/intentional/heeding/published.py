"""What the released controller heeds, whose list was fixed."""

from collections.abc import Iterable

from agents.intentional.heeding.scene import Scene
from asp.language import Literal
from asp.reasoning import knowledge
from testbed.protocol import Task


class Published:
    """Heeds fluents of the goal, and those that decide one through a single state constraint.

    Where a book is seen decides that it is nowhere else.
    """

    def __init__(self, task: Task) -> None:
        own = {literal.atom for literal in task.goal}
        constraints = knowledge(task.domain, task.source).description.constraints
        laws = (law for law in constraints if law.head.atom in own)
        self._fluents = own.union(condition.atom for law in laws for condition in law.body)

    def heeded(self, scene: Scene, /) -> Iterable[Literal]:
        return [literal for literal in scene.visible if literal.atom in self._fluents]
