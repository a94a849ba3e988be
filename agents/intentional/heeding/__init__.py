"""Which visible literals a robot heeds, by the configuration's `relevance`."""

from collections.abc import Callable, Mapping

from agents.intentional.heeding.all import All
from agents.intentional.heeding.definition import Definition
from agents.intentional.heeding.plan import Plan
from agents.intentional.heeding.published import Published
from agents.intentional.heeding.scene import Heeding as Heeding
from agents.intentional.heeding.scene import Scene as Scene
from testbed.protocol import Relevance, Task

HEEDING: Mapping[Relevance, Callable[[Task], Heeding]] = {
    "published": Published,
    "definition": Definition,
    "plan": Plan,
    "all": All,
}
