"""The drawings of a page: of each state one, to which steps refer by number."""

from collections.abc import Callable, Sequence
from functools import lru_cache, partial
from pathlib import Path

from asp.language import Description, Fluent, Literal, load_description
from asp.refinement import Refinement
from testbed.config import ExperimentConfig, level_size, refinement_of_files, refinement_of_size
from testbed.environment.rendering import Stage, draw_svg
from testbed.experiment.stories import believed
from testbed.world import World, load_world, world_of

Atoms = frozenset[Fluent]


class Theatre:
    """Where trials are played: the stage of the world, and that of what a robot believes of it.

    At the fine resolution a robot's belief is of the coarse one. `world` is made when called.
    """

    def __init__(
        self, world: Callable[[], World], description: Description, coarse: Description
    ) -> None:
        self.world = world
        robot = coarse.robots[0]
        self.stage, self.believed = Stage(description, robot), Stage(coarse, robot)
        self.fluents = frozenset(coarse.fluents)


@lru_cache(maxsize=16)
def _coarse(domain: str) -> Theatre:
    description = load_description(domain)
    return Theatre(partial(load_world, domain), description, description)


@lru_cache(maxsize=16)
def _fine(refinement: Refinement) -> Theatre:
    world = world_of(refinement)
    return Theatre(lambda: world, world.description, refinement.description)


def theatre_of(config: ExperimentConfig, level: str) -> Theatre:
    """That of the trials of a run at a level. Raises SourceError and OSError."""
    if not config.is_fine:
        return _coarse(config.domain)
    own = config.refinement
    if own is not None and level == Path(own).stem:
        return _fine(refinement_of_files(config.domain, own))
    return _fine(refinement_of_size(level_size(config, level)))


class Scenes:
    """The drawings, each once, in the order in which they are asked for."""

    def __init__(self) -> None:
        self.drawn: list[str] = []
        self._numbers: dict[str, int] = {}
        self._known: dict[tuple[int, Atoms, tuple[Literal, ...]], int] = {}

    def world(self, theatre: Theatre, true: Atoms) -> int:
        """The number of the drawing of what is true."""
        return self._number(theatre.stage, true, ())

    def belief(self, theatre: Theatre, true: Atoms, mistaken: Sequence[Literal]) -> int:
        """The same of what is believed, with what differs from what is true marked."""
        own = believed(true & theatre.fluents, list(mistaken))
        return self._number(theatre.believed, own, tuple(mistaken))

    def keep(self, number: int) -> None:
        """Forget all but the first ones."""
        del self.drawn[number:]
        self._numbers = {svg: n for svg, n in self._numbers.items() if n < number}
        self._known = {key: n for key, n in self._known.items() if n < number}

    def _number(self, stage: Stage, true: Atoms, marked: tuple[Literal, ...]) -> int:
        key = id(stage), true, marked
        if key not in self._known:
            svg = draw_svg(stage.still(true), marked)
            self._known[key] = self._numbers.setdefault(svg, len(self.drawn))
            if self._known[key] == len(self.drawn):
                self.drawn.append(svg)
        return self._known[key]
