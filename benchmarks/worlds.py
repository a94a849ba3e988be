"""The world at the fine resolution: what a step costs, and what listing every event does."""

from collections.abc import Iterator
from itertools import islice

import numpy as np

from agents.adversary import AdversaryView, Game, Random
from asp.domains import LEVELS, LevelSize, level_text
from asp.language import Action
from asp.refinement import Refinement, load
from benchmarks.measuring import median, no_collection, quantile, timed
from benchmarks.sheets import Row, Sheet, gathered
from testbed.environment import Core, Rules, fine_core
from testbed.protocol import WAIT
from testbed.world import world_of

_STEPS = {"small": 40, "full": 400}
_LISTED = {"small": 1, "full": 3}
_RATE, _STATISTICS = 0.05, {"fine_move": 0.85, "test_fine_loc": 0.9}


def main(size: str) -> list[Sheet]:
    """A sheet with one row per level."""
    names = ("L1", "L3") if size == "small" else tuple(LEVELS)
    rows = gathered(_row(name, LEVELS[name], size) for name in names)
    notes = (
        "load: the refinement from its texts; build: the world; reset: a random state;",
        "step: the adversary's draw, the step and the percept; events: all that is legal.",
    )
    return [Sheet("worlds", "The world at the fine resolution", rows, notes)]


def _row(name: str, level: LevelSize, size: str) -> Row:
    loading, refinement = timed(lambda: _refinement(name, level))
    building, world = timed(lambda: world_of(refinement))
    core = _game(refinement)
    twin = _game(_refinement(f"{name} again", level))
    resets = [timed(lambda: core.reset(1))[0] for _ in range(5)]
    with no_collection():
        steps = list(_steps(core, twin, _STEPS[size]))
        listings = []
        for _ in range(_LISTED[size]):
            list(_steps(core, twin, 10))
            listings.append(timed(lambda: core.events(None))[0])
    return {
        "level": name,
        "fluents": len(world.fluents),
        "robot_actions": len(core.robot_actions),
        "events": len(world.exogenous_actions),
        "load_ms": round(loading),
        "build_ms": round(building, 1),
        "reset_ms": round(median(resets), 1),
        "step_median_ms": round(median(steps), 3),
        "step_p99_ms": round(quantile(steps, 0.99), 3),
        "events_ms": round(median(listings), 1),
    }


def _refinement(name: str, level: LevelSize) -> Refinement:
    coarse, fine = level_text(level.rooms, level.rows, level.columns, level.objects)
    return load(coarse, f"{name}.al", fine, f"{name}.fine")


def _game(refinement: Refinement) -> Core:
    return fine_core(refinement, Rules(goal=(), steps=10**9), _STATISTICS)


def _steps(core: Core, twin: Core, steps: int) -> Iterator[float]:
    """Milliseconds of steps in which the robot does something possible, at random.

    What is possible is asked of the twin, so that the core does not know it from before.
    """
    game = Game(
        scenario="",
        goal=(),
        exogenous_actions=core.world.exogenous_actions,
        description=core.world.description,
    )
    adversary, choose = Random(game, Random.Options(_RATE)), np.random.default_rng(1)
    for _ in range(steps):
        action = _possible(twin, core.situation.state, choose)

        def play(action: Action = action) -> None:
            legal = core.legal_events(action)
            event = adversary.act(AdversaryView(core.situation.step, frozenset(), action, legal))
            core.advance(action, event)
            _ = core.percept

        yield timed(play)[0]


def _possible(core: Core, state: int, choose: np.random.Generator) -> Action:
    """An action that can come to something in the state: one of the kinds, then one of it."""
    kinds: dict[str, list[Action]] = {}
    for action in core.execution.actions:
        kinds.setdefault(action.name, []).append(action)
    for kind in choose.permutation(list(kinds)):
        drawn = (kinds[kind][int(number)] for number in choose.permutation(len(kinds[kind])))
        possible = [a for a in islice(drawn, 400) if core.execution.possible(state, a)]
        if possible:
            return possible[0]
    return WAIT
