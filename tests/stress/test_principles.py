"""Principles hold for the packaged robots in small domains, and each finds what breaks it."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from msgspec import structs

from asp.language import Action, Literal
from testbed.config import StressSettings
from testbed.experiment.episodes import Episode, Player
from testbed.experiment.storyteller import Moment
from testbed.protocol import FINISH, WAIT, Event
from testbed.search import as_it_is, cheapest_plan
from testbed.stress.cases import cases_of
from testbed.stress.mind import beliefs
from testbed.stress.principles import principles
from testbed.stress.verdicts import Finding
from tests.stress.domains import DOMAINS, search_in

THINKING = "exogenous_while_thinking=true"


def _episodes(tmp_path: Path, domain: str, robot: str, *more: str) -> list[Episode]:
    """The episodes with no and with one event of a few cases."""
    config = search_in(tmp_path, domain, f"robots=[{robot}]", THINKING, *more)
    found = []
    for case in cases_of(config):
        player = Player(case)
        added = list(player.additions(()))
        found += [player.episode(()), *player.branches((), added)]
    return found


def _broken(episode: Episode) -> list[Finding]:
    return list(principles(episode, StressSettings()).findings)


@pytest.mark.parametrize("robot", ["intentional", "traditional"])
@pytest.mark.parametrize("domain", DOMAINS)
def test_the_robots_break_none(domain: str, robot: str, tmp_path: Path) -> None:
    for told in ("observability={}", "knowledge=seen"):
        if (robot, told) == ("traditional", "knowledge=seen"):
            continue
        for episode in _episodes(tmp_path, domain, robot, told):
            assert _broken(episode) == []


Change = Callable[[Episode, Moment], Moment | None]
"""A moment in place of one of an episode; None where there is no use of it."""


def _waits(_: Episode, moment: Moment) -> Moment | None:
    if moment.decision.action in (WAIT, FINISH):
        return None
    return replace(moment, decision=structs.replace(moment.decision, action=WAIT))


def _stops(_: Episode, moment: Moment) -> Moment | None:
    if moment.decision.action in (WAIT, FINISH):
        return None
    stop = Action.of("stop", "1")
    trace = structs.replace(moment.decision.trace, mental=stop, intention=stop, plan=[])
    return replace(moment, decision=structs.replace(moment.decision, action=WAIT, trace=trace))


def _gives_up(_: Episode, moment: Moment) -> Moment | None:
    if moment.decision.action in (WAIT, FINISH):
        return None
    trace = structs.replace(moment.decision.trace, intention=FINISH, mental=None)
    return replace(moment, decision=structs.replace(moment.decision, action=FINISH, trace=trace))


def _forgets(_: Episode, moment: Moment) -> Moment | None:
    trace = moment.decision.trace
    if not trace.belief:
        return None
    believed = structs.replace(trace, belief=trace.belief[1:], unheeded=[])
    return replace(moment, decision=structs.replace(moment.decision, trace=believed))


def _explains_too_much(episode: Episode, moment: Moment) -> Moment | None:
    trace = moment.decision.trace
    if trace.explanation is None or not trace.explanation.unobserved:
        return None
    event = episode.setup.world.exogenous_actions[0]
    assumed = [*trace.explanation.unobserved, Event(step=1, action=event)]
    more = structs.replace(trace.explanation, unobserved=assumed)
    own = structs.replace(moment.decision, trace=structs.replace(trace, explanation=more))
    return replace(moment, decision=own)


def _detours(episode: Episode, moment: Moment) -> Moment | None:
    trace, world = moment.decision.trace, episode.setup.world
    if trace.mental is None or trace.mental.name != "start":
        return None
    goal: tuple[Literal, ...] = episode.spec.setting.goal
    here = next(own.state for own in beliefs(episode) if own.moment is moment)
    assert here is not None
    for action, after in world.moves(here):
        rest = cheapest_plan(as_it_is(world, after, goal))
        if rest is not None and len(rest) >= len(trace.plan):
            detour = structs.replace(trace, plan=[action, *rest])
            return replace(moment, decision=structs.replace(moment.decision, trace=detour))
    return None


CHANGES: dict[str, Change] = {
    "procrastination": _waits,
    "stopped": _stops,
    "gave up": _gives_up,
    "no state": _forgets,
    "disagreement": _forgets,
    "not minimal": _explains_too_much,
    "not shortest": _detours,
}


@pytest.mark.parametrize("rule", CHANGES)
def test_each_is_broken_by_a_robot_that_does_otherwise(rule: str, tmp_path: Path) -> None:
    """The decision of one step of a real episode is replaced."""
    tried = 0
    for domain in DOMAINS:
        for episode in _episodes(tmp_path, domain, "intentional")[:40]:
            for number, moment in enumerate(episode.moments):
                other = CHANGES[rule](episode, moment)
                if other is None:
                    continue
                tried += 1
                moments = (*episode.moments[:number], other, *episode.moments[number + 1 :])
                found = _broken(replace(episode, moments=moments))
                if (rule, moment.percept.step) in {(own.rule, own.step) for own in found}:
                    return
    pytest.fail(f"{rule} was not found in {tried} episodes in which it was broken")
