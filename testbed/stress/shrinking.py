"""Shrink what was found: the simplest episode in which the same rule is broken.

Greedy, as property-based testing does it: of the simpler episodes one that still has the finding is
taken, until none has.
"""

from collections.abc import Iterator
from itertools import islice

import msgspec

from agents.adversary import Events
from testbed.config import StressSettings
from testbed.environment import Observability
from testbed.experiment.episodes import Episode, Player
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial_setup import setup_of
from testbed.search import BudgetError, as_it_is, cheapest_plan
from testbed.stress.cases import case_of
from testbed.stress.objectives import judged
from testbed.stress.verdicts import Finding
from testbed.world import World

MOST_EPISODES = 400
"""That are played to shrink one finding."""

Size = tuple[int, int, int, int, int, str]
Simpler = tuple[TrialSpec, Events]


class Shrunk(msgspec.Struct, frozen=True):
    """The simplest episode that was found, by its case and events, and what is found in it.

    `repeated` is whether the finding was there when the episode was played again.
    """

    case: TrialSpec
    events: Events
    length: int
    chance: float | None
    finding: Finding
    repeated: bool = True

    @property
    def spec(self) -> TrialSpec:
        """The trial with the events as its script."""
        setting = msgspec.structs.replace(self.case.setting, script=self.events)
        return msgspec.structs.replace(self.case, setting=setting)


def shrunk(
    root: int, case: TrialSpec, events: Events, settings: StressSettings, finding: Finding
) -> Shrunk | None:
    """The simplest episode with a finding of the same objective and rule.

    None where the episode is played again without it: the robot does not decide alike twice.

    Simpler are fewer events, then fewer literals of the goal, events of which less is told, fewer
    steps, and earlier events. `root` is the seed of the configuration. At most `MOST_EPISODES`
    are played.
    """
    return _Shrinking(root, settings, finding).from_(case, events)


class _Shrinking:
    def __init__(self, root: int, settings: StressSettings, wanted: Finding) -> None:
        self._root, self._settings, self._wanted = root, settings, wanted
        self._left = MOST_EPISODES

    def from_(self, case: TrialSpec, events: Events) -> Shrunk | None:
        best = self._found(case, Player(case).episode(events))
        while best is not None and (smaller := self._smaller(best)) is not None:
            best = smaller
        return best

    def _smaller(self, best: Shrunk) -> Shrunk | None:
        """The first simpler episode that has the finding, too."""
        for case, events in islice(self._simpler(best), self._left):
            self._left -= 1
            found = self._found(case, Player(case).episode(events))
            if found is not None and _size(found) < _size(best):
                return found
        return None

    def _found(self, case: TrialSpec, episode: Episode) -> Shrunk | None:
        wanted = self._wanted.objective, self._wanted.rule
        for found in judged(episode, self._settings).findings:
            if (found.objective, found.rule) == wanted:
                length = len(episode.moments)
                return Shrunk(case, episode.events, length, episode.chance, found)
        return None

    def _simpler(self, best: Shrunk) -> Iterator[Simpler]:
        case, events, setting = best.case, best.events, best.case.setting
        for number in range(len(events)):
            yield case, (*events[:number], *events[number + 1 :])
        for changes in _simpler_settings(case):
            other = msgspec.structs.replace(setting, **changes)
            yield case_of(self._root, case, setting=other), events
        if setting.fine is None:
            for initial in _nearer(case):
                nearer = case_of(self._root, case, initial=initial)
                for earlier in range(events[0][0] if events else 1):
                    yield nearer, tuple((step - earlier, event) for step, event in events)
        for number, (step, event) in enumerate(events):
            first = events[number - 1][0] + 1 if number else 1
            for earlier in range(first, step):
                yield case, (*events[:number], (earlier, event), *events[number + 1 :])


def _simpler_settings(case: TrialSpec) -> Iterator[dict[str, object]]:
    """Less of a goal, and less that the robot is told of."""
    goal, told = case.setting.goal, case.setting.observability
    for number in range(len(goal)):
        if len(goal) > 1:
            yield {"goal": (*goal[:number], *goal[number + 1 :])}
    if told:
        yield {"observability": {}}
    for name, rules in told.items():
        yield {"observability": {key: own for key, own in told.items() if key != name}}
        if rules != (certain := Observability(mode=rules.mode)):
            yield {"observability": {**told, name: certain}}


def _nearer(case: TrialSpec) -> Iterator[tuple[object, ...]]:
    """The initial states that a shortest plan passes, the nearest to the goal first.

    None where it takes more than `limits.judge_states` states to find one.
    """
    world, setting = setup_of(case.setting).world, case.setting
    state, passed = world.state(case.initial), list[int]()
    try:
        plan = cheapest_plan(as_it_is(world, state, setting.goal), None, setting.judge_states)
    except BudgetError:
        return
    for action in list(plan or ())[:-1]:
        reached = world.successors(state, (action,))
        if len(reached) != 1:
            break
        (state,) = reached
        passed.append(state)
    yield from (_atoms(world, own) for own in reversed(passed) if world.is_initial(own))


def _atoms(world: World, state: int) -> tuple[object, ...]:
    return tuple(sorted(world.true_atoms(state)))


def _size(found: Shrunk) -> Size:
    setting = found.case.setting
    told = sum(1 + (own != Observability(mode=own.mode)) for own in setting.observability.values())
    steps = sum(step for step, _ in found.events)
    return len(found.events), len(setting.goal), told, found.length, steps, str(found.events)
