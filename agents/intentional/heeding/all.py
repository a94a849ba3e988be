"""Everything in view."""

from collections.abc import Iterable

from agents.intentional.heeding.scene import Scene
from asp.language import Literal
from testbed.protocol import Task


class All:
    """Heeds whatever is visible."""

    def __init__(self, task: Task) -> None:
        del task  # it makes no difference

    def heeded(self, scene: Scene, /) -> Iterable[Literal]:
        return scene.visible
