"""A restored robot decides as the one whose snapshot it is, whatever was done in between."""

from pathlib import Path
from random import Random

import pytest

from testbed.experiment.robots import ROBOTS, make_robot
from testbed.experiment.snapshots import restorable_robot
from testbed.experiment.specs import TrialSpec
from tests.agents.branching import Branch, Game, replayed, spec_of
from tests.pots import write_pots

TOLD = "observability={exo_move: {mode: always, probability: 0.5, delay: 2, false_reports: 0.1}}"
OFFICE = (
    "office",
    "scenarios=[none]",
    "adversary.strategy=random",
    "exogenous_while_thinking=true",
)
FINE = ("levels", "limit=1", "limits.steps=60", "observability.fine_exo_move.mode=always")
BOOKS = (
    "levels=[]",
    "refinement=office.fine",
    "goal=['loc(book1,library)']",
    "observability.exo_lock={mode: always, delay: 3}",
)
LAMPS = """\
sorts
  robot = {porter}.
  lamp  = {red, green}.
  hall  = {west, middle, east}.
fluents
  inertial stays(robot, hall).
  inertial lit(lamp).
  inertial current.
actions
  agent     walk(robot, hall).
  agent     throw(robot).
  agent     cut(robot).
  exogenous surge.
  exogenous trip.
laws
  walk(R, H) causes stays(R, H).
  throw(R) causes current.
  cut(R) causes -current.
  cut(R) causes lit(L).
  surge causes current.
  trip causes -current.
  -stays(R, H2) if stays(R, H1), H1 != H2.
  -lit(L) if lit(M), current, L != M.
  impossible walk(R, H) if stays(R, H).
  impossible throw(R) if current.
  impossible cut(R) if -current.
  impossible throw(R) if -stays(R, west).
  impossible cut(R) if -stays(R, west).
  impossible surge if current.
  impossible trip if -current.
initially
  stays(R, H) for some H.
sees
  R sees stays(R, H) if robot(R).
  R sees lit(L) if stays(R, west).
"""
"""Of two lamps one stays lit when there is current; both are seen from one hall only."""
LAMPS_CONFIG = """\
name: lamps
domain: lamps.al
goal: ["lit(red)", "current", "stays(porter,east)"]
initial: ["stays(porter,middle)"]
link: inprocess
exogenous_while_thinking: true
adversary: {strategy: random}
observability: {surge: {mode: always, probability: 0.3, delay: 1}}
limits: {plan: 6, steps: 20}
"""


def lamps(folder: Path, *overrides: str) -> TrialSpec:
    (folder / "lamps.al").write_text(LAMPS, encoding="utf-8")
    (folder / "lamps.yaml").write_text(LAMPS_CONFIG, encoding="utf-8")
    return spec_of(folder / "lamps.yaml", *overrides)


def check(
    spec: TrialSpec, robot: str, seed: int, rate: float, points: int = 5, on: int = 8
) -> None:
    """Plays a trial, and on from some of its moments, twice from each, in a random order.

    All that is decided there is compared with a robot that never goes back.
    """
    random, game = Random(seed), Game(spec, rate)
    played, other = restorable_robot(robot, False), restorable_robot(robot, False)
    played.begin(game.task)
    trunk = Branch()
    kept = [
        (len(trunk.decisions), game.core.snapshot(), played.snapshot())
        for _ in game.play(played, random, spec.setting.step_limit, trunk)
    ]
    chosen = random.sample(kept[:-1], min(points, len(kept) - 1))
    assert chosen
    for step, core, snapshot in random.sample(chosen * 2, len(chosen) * 2):
        game.core.restore(core)
        restored = random.choice([played, other])  # the other one never began
        restored.restore(snapshot)
        branch = Branch()
        for _ in game.play(restored, random, on, branch):
            restored.restore(restored.snapshot())
        percepts = [*trunk.percepts[:step], *branch.percepts]
        decisions = [*trunk.decisions[:step], *branch.decisions]
        assert replayed(make_robot(robot), game.task, percepts) == decisions, f"from {step} on"


def test_all_robots_of_the_testbed_have_snapshots() -> None:
    assert all(ROBOTS.find(name).capabilities.snapshots for name in ROBOTS.built_in)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("robot", ["intentional", "traditional", "intentional-checking"])
@pytest.mark.parametrize("more", [(), (TOLD, "knowledge=seen")], ids=["unseen", "told"])
def test_in_the_office(robot: str, seed: int, more: tuple[str, ...]) -> None:
    check(spec_of(*OFFICE, "limits.steps=24", f"seed={seed}", *more), robot, seed, rate=0.4)


@pytest.mark.parametrize("robot", ["intentional", "traditional"])
def test_in_a_history_that_is_compressed(robot: str) -> None:
    check(spec_of(*OFFICE, "limits.steps=60"), robot, seed=5, rate=0.9, points=3)


@pytest.mark.parametrize(
    "robot", ["intentional-plain", "traditional-plain", "intentional-joint-staged"]
)
def test_reasoning_from_scratch(robot: str, tmp_path: Path) -> None:
    check(spec_of(write_pots(tmp_path), "limits.steps=8"), robot, 1, rate=0.7, points=2, on=3)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("robot", ["intentional", "traditional"])
@pytest.mark.parametrize("plans", ["optimistic", "conformant"])
def test_where_actions_have_several_outcomes(
    robot: str, plans: str, seed: int, tmp_path: Path
) -> None:
    check(lamps(tmp_path, f"plans={plans}", f"seed={seed}"), robot, seed, rate=0.3)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("robot", ["intentional", "intentional-nozoom"])
@pytest.mark.parametrize("map", [("levels=[L1]",), BOOKS], ids=["level", "books"])
def test_in_the_middle_of_an_abstract_action(map: tuple[str, ...], robot: str, seed: int) -> None:
    check(spec_of(*FINE, *map, f"seed={seed}"), robot, seed, rate=0.2, points=6, on=20)
