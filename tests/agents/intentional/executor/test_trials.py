"""Trials in the fine world with the published statistics, and events at random."""

import numpy as np
import pytest

from agents.adversary import AdversaryView, Game, Random
from agents.intentional.refined import EitherRobot, WithoutZooming
from asp.domains import LEVELS, level_text
from asp.language import read_domain
from asp.refinement import load, read_refinement
from testbed.environment import Ending, Observability, RandomStart, Rules, fine_core
from testbed.protocol import FineTrace, Task
from testbed.world import world_of
from tests.literals import parsed

STATISTICS = {"fine_move": 0.85, "test_fine_loc": 0.9}
TOLD = {"fine_exo_move": Observability("always")}


def texts(name: str) -> tuple[str, str]:
    """The coarse text and the fine one of a level, or of the packaged office."""
    if name == "office":
        return read_domain("office")[1], read_refinement("office.fine")[1]
    size = LEVELS[name]
    return level_text(size.rooms, size.rows, size.columns, size.objects)


def trial(
    name: str, seed: int, zooms: bool = True, told: bool = False, rate: float = 0.05
) -> list[FineTrace]:
    """Plays a trial to its end, which has to be an achieved goal."""
    coarse, fine = texts(name)
    refinement = load(coarse, "level.al", fine, "level.fine")
    world = world_of(refinement)
    random = np.random.default_rng(seed)
    state = RandomStart(world, "rob1")(random)
    true = frozenset(world.true_atoms(state))
    sorts = refinement.coarse_signature.sorts
    thing = str(random.choice(sorts["object"]))
    wanted = sorts.get("secure_room", sorts["room"])
    rooms = [room for room in wanted if f"loc({thing},{room})" not in true] or ["kitchen"]
    goal = parsed([f"loc({thing},{random.choice(rooms)})"])
    rules = Rules(tuple(goal), steps=1500, observability=TOLD if told else {})
    core = fine_core(refinement, rules, STATISTICS, initial=[state])
    core.reset(seed=seed, trial="trial")
    game = Game(
        scenario="",
        goal=tuple(goal),
        exogenous_actions=world.exogenous_actions,
        description=refinement.description,
    )
    adversary = Random(game, Random.Options(rate))
    adversary.reset(seed)
    robot = EitherRobot() if zooms else WithoutZooming()
    robot.begin(
        Task(
            trial="trial",
            robot="intentional",
            domain="level",
            source=coarse,
            goal=goal,
            initial=[f if f in true else f.complement for f in refinement.description.fluents],
            plan_limit=20,
            seed=seed,
            refinement=fine,
            initial_fine=[f for f in sorted(true) if f.startswith("fine_") and "rob1" in f],
        )
    )
    traces = []
    while core.situation.ending is None:
        decision = robot.act(core.percept)
        assert decision.trace.fine is not None
        traces.append(decision.trace.fine)
        view = AdversaryView(
            step=core.situation.step,
            state=frozenset(world.true_atoms(core.situation.state)),
            robot_action=decision.action,
            legal=core.legal_events(decision.action),
        )
        core.advance(decision.action, adversary.act(view))
    assert core.situation.ending is Ending.ACHIEVED
    return traces


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", ["L1", "L2", "L3", "L4"])
def test_the_goal_is_achieved(name: str, seed: int) -> None:
    traces = trial(name, seed)
    last = traces[-1]
    assert last.plans <= last.actions <= len(traces)
    assert last.actions + last.tests <= len(traces)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["L2", "L3"])
def test_also_without_zooming(name: str, seed: int) -> None:
    trial(name, seed, zooms=False)


@pytest.mark.parametrize("seed", range(6))
def test_also_where_events_are_told(seed: int) -> None:
    trial("L2", seed, told=True)


@pytest.mark.parametrize("zooms", [True, False])
def test_also_where_others_lock_a_room(zooms: bool) -> None:
    played = [trace for seed in range(6) for trace in trial("office", seed, zooms, rate=0.2)]
    assert any("unlock(rob1,library)" in trace.plan for trace in played)
