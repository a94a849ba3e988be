"""The story of a trial has what its moments had, for any domain, at both resolutions."""

from pathlib import Path

from benchmarks.own import Own
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.stories import Story, believed, decode
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.world import World, load_world
from tests.experiment.gardens import GARDEN, ROWS

RAKED = GARDEN.replace("OTHER", "rake")
LARGER = RAKED.replace("{north, south}", "{north, middle, south}").replace(
    "beside(north, south).", "beside(north, middle).\n  beside(middle, south)."
)


def _stories(config: Path, *overrides: str) -> list[tuple[Story, list[Moment], World]]:
    """The stories of all trials, with their moments and their worlds."""
    told = []
    for spec in plan_trials(load_config(config, overrides)):
        moments: list[Moment] = []
        result = play_trial(spec, InProcessRobot(make_robot), moments.append)
        assert result.story is not None
        told.append((decode(result.story), moments, load_world(spec.setting.domain)))
    return told


def test_a_story_has_the_world_and_the_belief_of_each_moment(tmp_path: Path) -> None:
    mistakes = explanations = events = 0
    goal = ["stands(spade,south)", "stands(rake,north)"]
    file = Own(tmp_path, LARGER).write(goal=goal, limit=12)
    windy = ("adversary={strategy: random, rate: 0.5}", "observability={stray: {mode: never}}")
    for story, moments, world in _stories(file, *windy):
        *states, end = story.states()
        assert states == [frozenset(world.true_atoms(moment.before)) for moment in moments]
        assert end == frozenset(world.true_atoms(moments[-1].after))
        for step, moment, true in zip(story.steps, moments, states, strict=True):
            trace = moment.decision.trace
            assert (step.step, step.action) == (moment.decision.step, moment.decision.action)
            assert (step.happened, step.event) == (moment.happened, moment.event)
            assert (step.intention, step.plan, step.reason) == (
                trace.intention,
                trace.plan,
                trace.reason,
            )
            assert step.explanation == trace.explanation
            assert (step.mistaken is None) == (not trace.belief)
            if step.mistaken is not None:
                assert believed(true, step.mistaken) == frozenset(trace.belief)
            mistakes += bool(step.mistaken)
            explanations += step.explanation is not None
            events += step.event is not None
    assert min(mistakes, explanations, events) > 0


def test_at_the_fine_resolution_the_belief_is_of_the_coarse_one(tmp_path: Path) -> None:
    own = Own(tmp_path, RAKED, ROWS)
    file = own.write(goal=["stands(spade,south)"], limit=4, robots=["intentional"])
    reported = 0
    for story, moments, world in _stories(file, "adversary.rate=0.3"):
        coarse = frozenset(world.fluents)
        for step, moment, true in zip(story.steps, moments, story.states(), strict=False):
            trace = moment.decision.trace
            assert {own.name for own in true} >= {"fine_stands", "stands"}
            assert step.fine is not None
            assert trace.fine is not None
            assert (step.fine.abstract, step.fine.plan) == (trace.fine.abstract, trace.fine.plan)
            if step.mistaken is not None:
                assert believed(true & coarse, step.mistaken) == frozenset(trace.belief)
                reported += 1
    assert reported > 4
