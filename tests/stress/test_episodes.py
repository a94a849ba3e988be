"""Episodes by snapshots are those of trials that are played from their start, event by event."""

from collections.abc import Sequence
from itertools import islice
from math import exp
from pathlib import Path

import pytest

from agents.adversary import Events
from testbed.config import load_config
from testbed.experiment.episodes import Episode, Player
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.stress.cases import cases_of, configuration_of
from testbed.stress.stories import PREFIX
from testbed.stress.units import Branching
from tests.stress.domains import DOMAINS, search_in

THINKING = "exogenous_while_thinking=true"


def _played(spec: TrialSpec) -> tuple[object, ...]:
    """What a trial of a run comes to."""
    record = play_trial(spec, InProcessRobot(make_robot)).record
    events = [(own.step, own.action) for own in record.exogenous]
    outcome = "false_finish" if record.outcome == "gave_up" else record.outcome
    return outcome, record.steps, record.execution_units, events


def _told(episode: Episode) -> tuple[object, ...]:
    assert episode.ending is not None
    return episode.ending, len(episode.moments), episode.units, [*episode.events]


def _first_branches(cases: Sequence[TrialSpec]) -> list[Episode]:
    """An episode with one event of each case in which one is legal."""
    players = {Player(case): [*Player(case).additions(())][:1] for case in cases}
    found = [own for player, added in players.items() for own in player.branches((), added)]
    assert found
    return found


@pytest.mark.parametrize("domain", DOMAINS)
def test_every_branch_is_the_trial_with_this_script(domain: str, tmp_path: Path) -> None:
    config = search_in(tmp_path, domain, THINKING, "stress.fair=false")
    for case in cases_of(config):
        player = Player(case)
        added = list(player.additions(()))
        for occurrence, branch in zip(added, player.branches((), added), strict=True):
            assert branch.events == (occurrence,)
            assert _told(branch) == _played(branch.spec)
            again = Player(case).episode((occurrence,))
            assert _told(again) == _told(branch)


@pytest.mark.parametrize("domain", DOMAINS)
def test_behind_an_event_every_legal_one_is_tried(domain: str, tmp_path: Path) -> None:
    case = cases_of(search_in(tmp_path, domain, THINKING))[-1]
    player = Player(case)
    for first in islice(player.additions(()), 3):
        added = list(player.additions((first,)))
        assert all(step > first[0] for step, _ in added)
        for occurrence, branch in zip(added, player.branches((first,), added), strict=True):
            assert branch.events == (first, occurrence)
            assert _told(branch) == _played(branch.spec)


def test_what_is_not_legal_is_left_out(tmp_path: Path) -> None:
    case = cases_of(search_in(tmp_path, "greenhouse"))[0]
    (step, event), *_ = Player(case).additions(())
    twice = ((step, event), (step + 1, event), (99, event))
    assert Player(case).episode(twice).events == ((step, event),)


def test_a_case_is_the_trial_of_its_configuration(tmp_path: Path) -> None:
    """Also where a seed draws what becomes of events: what is told of them."""
    told = "observability={blow: {mode: always, probability: 0.5}}"
    config = search_in(tmp_path, "greenhouse", THINKING, told, "repeats=2", "limit=6")
    cases = cases_of(config)
    assert len(cases) == len({(own.robot, own.initial) for own in cases})
    for episode in _first_branches(cases):
        case = episode.spec
        (trial,) = plan_trials(configuration_of(config, episode.spec, f"{PREFIX}1"))
        assert (trial.seed, trial.initial) == (case.seed, case.initial)
        assert _told(episode) == _played(trial)


def test_a_case_of_a_level_is_the_trial_of_its_configuration() -> None:
    config = load_config("levels", ["levels=[L1]", "limit=2", "robots=[intentional]"])
    for branch in _first_branches(cases_of(config)):
        (trial,) = plan_trials(configuration_of(config, branch.spec, "one"))
        assert trial.seed == branch.spec.seed
        assert _told(branch) == _played(trial)


def test_chances_of_all_episodes_of_a_case_add_up_to_one(tmp_path: Path) -> None:
    """Where one event is possible at most: the probabilities are those of a strategy."""
    random = ("adversary.strategy=random", "adversary.rate=0.3", "adversary.budget=1")
    for case in cases_of(search_in(tmp_path, "greenhouse", *random)):
        result = Branching(case, ()).play(search_in(tmp_path, "greenhouse").stress)
        chances = [own.chance for own in result.judged]
        assert sum(exp(own) for own in chances if own is not None) == pytest.approx(1.0)


def test_of_many_next_events_a_sample_is_tried(tmp_path: Path) -> None:
    config = search_in(tmp_path, "ferry", "stress.branches=2", THINKING)
    cases = cases_of(config)
    case = max(cases, key=lambda own: len([*Player(own).additions(())]))
    unit = Branching(case, ())
    result = unit.play(config.stress)
    whole: list[Events] = [(own,) for own in Player(unit.case).additions(())]
    assert len(result.judged) == 3
    assert result.left_out == len(whole) - 2
    assert {own.events for own in result.judged[1:]} < set(whole)
    assert result == unit.play(config.stress)
