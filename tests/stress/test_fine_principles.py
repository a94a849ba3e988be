"""Principles of the fine resolution hold for the packaged robot, and each finds what breaks it."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from msgspec import structs

from asp.language import Literal
from benchmarks.own import Own
from testbed.config import StressSettings, load_config
from testbed.experiment.episodes import Episode, Player
from testbed.experiment.storyteller import Moment
from testbed.protocol import FineTrace
from testbed.stress.cases import cases_of
from testbed.stress.principles import principles
from tests.experiment.gardens import GARDEN, ROWS
from tests.experiment.test_own_refinements import PATCHES, RAFTED

GARDEN_DRAW = {"goal": ["stands(tool,bed)", "-carries(helper,tool)"], "holding": 0.3}
RAFT_DRAW = {"goal": ["rests(thing,spot)"], "holding": 0.3}
DOMAINS = ("levels", "garden", "raft")
PLACES = {"fine_loc", "fine_stands", "fine_rests"}
"""Fluents of cells in which something is."""


def _config(domain: str, folder: Path) -> tuple[str | Path, list[str]]:
    if domain == "levels":
        return "levels", ["levels=[L2]", "adversary.rate=0", "statistics={}"]
    if domain == "garden":
        own = Own(folder, GARDEN.replace("OTHER", "rake"), ROWS)
        return own.write(draw=GARDEN_DRAW), []
    return Own(folder, RAFTED.text, PATCHES.text).write(draw=RAFT_DRAW), []


def _episodes(domain: str, folder: Path) -> list[Episode]:
    """The episodes with no and with one event of a few cases."""
    path, given = _config(domain, folder)
    found = []
    for case in cases_of(load_config(path, [*given, "robots=[intentional]", "limit=3"])):
        player = Player(case)
        added = list(player.additions(()))[:8]
        found += [player.episode(()), *player.branches((), added)]
    return found


def _broken(episode: Episode) -> set[tuple[str, int | None]]:
    return {(own.rule, own.step) for own in principles(episode, StressSettings()).findings}


@pytest.fixture(scope="module", params=DOMAINS)
def episodes(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> list[Episode]:
    return _episodes(request.param, tmp_path_factory.mktemp(request.param))


def test_the_robot_breaks_none(episodes: list[Episode]) -> None:
    assert [_broken(episode) for episode in episodes] == [set()] * len(episodes)


Change = Callable[[Episode, FineTrace, Moment], FineTrace | None]
"""A trace in place of one of an episode; None where there is no use of it."""


def _is_elsewhere(episode: Episode, trace: FineTrace, moment: Moment) -> FineTrace | None:
    """It takes for certain that it is in another cell than the one it is in."""
    own = {*trace.committed}.intersection(episode.setup.world.true_atoms(moment.before))
    for literal in (each for each in own if each.arguments[0] == episode.setup.robot):
        if literal.name not in PLACES:
            continue
        for other in episode.setup.world.fluents:
            if other != literal and _alike(other, literal):
                return structs.replace(trace, committed=[other])
    return None


def _jumps(episode: Episode, trace: FineTrace, moment: Moment) -> FineTrace | None:
    """It leaves out an action of a plan without which the next one is not possible."""
    world, plan = episode.setup.world, trace.plan
    for first, second in pairwise(plan):
        if _alike(first, second) and not world.executable(moment.before, (second,)):
            return structs.replace(trace, plan=[second])
    return None


def _alike(one: Literal, other: Literal) -> bool:
    """Whether two are the same but for the last argument, such as one robot in two cells."""
    return (one.name, one.arguments[:-1]) == (other.name, other.arguments[:-1])


CHANGES: dict[str, Change] = {"teleport": _is_elsewhere, "off the map": _jumps}


@pytest.mark.parametrize("rule", CHANGES)
def test_each_is_broken_by_a_robot_that_does_otherwise(rule: str, episodes: list[Episode]) -> None:
    """The trace of one step of a real episode is replaced; each such step is found."""
    tried = 0
    for episode in episodes:
        for number, moment in enumerate(episode.moments):
            fine = moment.decision.trace.fine
            other = None if fine is None else CHANGES[rule](episode, fine, moment)
            if other is None:
                continue
            tried += 1
            moments = _with(episode.moments, number, other)
            assert (rule, moment.percept.step) in _broken(replace(episode, moments=moments))
    assert tried


def _with(moments: Sequence[Moment], number: int, fine: FineTrace) -> tuple[Moment, ...]:
    moment = moments[number]
    trace = structs.replace(moment.decision.trace, fine=fine)
    other = replace(moment, decision=structs.replace(moment.decision, trace=trace))
    return (*moments[:number], other, *moments[number + 1 :])
