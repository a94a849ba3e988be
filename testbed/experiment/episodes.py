"""Episodes: trials with exogenous actions at given steps, played by a robot in this process.

A player goes back by snapshots of the game and of the robot, so that of episodes that begin alike
only what differs is played.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import log
from typing import Any

import msgspec

from agents.adversary import Events, Occurrence
from asp.language import Action
from testbed.environment import Core, Ending
from testbed.experiment.seeds import seeds_within
from testbed.experiment.snapshots import SnapshotError, going_back, restorable_robot
from testbed.experiment.specs import TrialSpec
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial_setup import TrialSetup, setup_of
from testbed.link import understood
from testbed.protocol import NONE, Decision, Restorable, RobotLost, encode, in_one_line

IMPOSSIBLE = -1e6
"""In place of the logarithm of 0, finite so that JSON has it."""


@dataclass(frozen=True)
class Episode:
    """A trial that was played to its end.

    `spec` is the trial with its events as the script, `state` the last state of the world. `ending`
    is None where the robot failed to answer, and `fault` then says in one line how. `chance` is the
    natural logarithm of the probability that the strategy `random` plays these events and no
    others; None where events have no rate.
    """

    spec: TrialSpec
    setup: TrialSetup
    moments: tuple[Moment, ...]
    state: int
    ending: Ending | None
    fault: str | None
    chance: float | None

    @property
    def events(self) -> Events:
        """What happened, and when."""
        return self.spec.setting.script or ()

    @property
    def achieved(self) -> bool:
        """Whether the robot finished with its goal achieved."""
        return self.ending is Ending.ACHIEVED

    @property
    def units(self) -> int:
        """The execution units of what the robot attempted, at the coarse resolution."""
        return sum(self.setup.costs.get(own, 0) for own in map(_attempted, self.moments) if own)

    @property
    def states(self) -> Iterator[int]:
        """Every state of the world, the first one included."""
        yield from (moment.before for moment in self.moments)
        yield self.state


def _attempted(moment: Moment) -> Action | None:
    """The coarse action that begins here; at the fine resolution that is the abstract one."""
    fine = moment.decision.trace.fine
    if fine is None:
        return moment.decision.action
    return fine.abstract if fine.begun == moment.percept.step else None


class Player:
    """Plays episodes of one case: a trial whose events are left to the caller.

    The game and the robot are made when the first episode begins, which raises RegistryError for a
    robot that there is not.
    """

    def __init__(self, case: TrialSpec) -> None:
        self._case, self._rate = case, case.setting.rate or None
        self._moments: list[Moment] = []
        self._fault: str | None = None
        self._chance = 0.0

    @cached_property
    def _setup(self) -> TrialSetup:
        return setup_of(self._case.setting)

    @cached_property
    def _core(self) -> Core:
        return self._setup.core(self._case.setting)

    @cached_property
    def _robot(self) -> Restorable:
        return restorable_robot(self._case.robot)

    def episode(self, events: Events) -> Episode:
        """The episode with these events; those that turn out not to be legal are left out."""
        self._begin()
        return self._played_on(dict(events))

    def additions(self, events: Events) -> Iterator[Occurrence]:
        """Each event that may be added behind the last one of an episode, in the order of steps."""
        planned, last = dict(events), max((step for step, _ in events), default=0)
        self._begin()
        while (decision := self._decision()) is not None:
            step = self._core.situation.step
            if step > last:
                yield from ((step, event) for event in self._legal(decision))
            self._advance(decision, self._planned(planned, decision))

    def branches(self, events: Events, added: Sequence[Occurrence]) -> Iterator[Episode]:
        """The episodes with one of the `added` events behind these each, in the order of steps.

        Raises:
            SnapshotError: for a robot that cannot go back, or does not decide alike again.
        """
        planned, ahead = dict(events), {step: list[Action]() for step, _ in added}
        for step, event in added:
            ahead[step].append(event)
        self._begin()
        while ahead and (decision := self._decision()) is not None:
            step = self._core.situation.step
            if step in ahead:
                before = self._snapshot()
                for event in ahead.pop(step):
                    self._check(decision, event)
                    self._advance(decision, event)
                    yield self._played_on({})
                    self._restore(before)
            self._advance(decision, self._planned(planned, decision))

    def _check(self, decision: Decision, event: Action) -> None:
        """Raises SnapshotError where an event that could be added once cannot be any more."""
        if not self._core.legal(decision.action, event):
            raise SnapshotError(
                f"'{self._case.robot}' does not decide alike twice: asked again, it answered "
                f"{decision.action} at step {self._core.situation.step}, where {event} was legal "
                "before; its decisions have to follow from its task and its percepts"
            )

    def _begin(self) -> None:
        self._moments, self._fault, self._chance = [], None, 0.0
        for_world, _, for_robot = seeds_within(self._case.seed)
        self._core.reset(seed=for_world, initial=self._case.initial, trial=self._case.trial)
        task = self._setup.task(self._case, self._core.situation.state, for_robot)
        self._asked(lambda: self._robot.begin(task))

    def _decision(self) -> Decision | None:
        """What the robot answers now; None where the episode is over, or the robot fails."""
        if self._fault is not None or self._core.situation.ending is not None:
            return None
        decision = self._asked(self._answer)
        if decision is not None and decision.action not in self._core.robot_actions:
            self._fault = f"answered '{decision.action}', which is not an action"
        return decision if self._fault is None else None

    def _answer(self) -> Decision:
        """What the robot answers, as a driver understands it: by its bytes."""
        percept = self._core.percept
        return understood(encode(self._robot.act(percept)), percept)

    def _asked(self, question: Callable[[], Any]) -> Any:
        """What the robot says; None where it raises an error, which is a finding about it."""
        try:
            return question()
        except RobotLost as loss:
            self._fault = loss.reason
            return None
        except SnapshotError:  # of the search, which needs a robot that decides alike again
            raise
        except (Exception, SystemExit) as error:
            self._fault = in_one_line(error)
            return None

    def _legal(self, decision: Decision) -> list[Action]:
        return [own for own in self._core.legal_events(decision.action) if own != NONE]

    def _planned(self, planned: Mapping[int, Action], decision: Decision) -> Action:
        event = planned.get(self._core.situation.step, NONE)
        return event if self._core.legal(decision.action, event) else NONE

    def _advance(self, decision: Decision, event: Action) -> None:
        if self._rate is not None:
            self._chance += chance_of(event, self._legal(decision), self._rate)
        percept, before = self._core.percept, self._core.situation.state
        self._core.advance(decision.action, event)
        now = self._core.situation
        happened = None if event == NONE else event
        self._moments.append(Moment(percept, decision, now.happened, happened, before, now.state))

    def _played_on(self, planned: dict[int, Action]) -> Episode:
        while (decision := self._decision()) is not None:
            self._advance(decision, self._planned(planned, decision))
        now = self._core.situation
        setting = msgspec.structs.replace(self._case.setting, script=now.played)
        return Episode(
            spec=msgspec.structs.replace(self._case, setting=setting),
            setup=self._setup,
            moments=tuple(self._moments),
            state=now.state,
            ending=now.ending,
            fault=self._fault,
            chance=None if self._rate is None else self._chance,
        )

    def _snapshot(self) -> tuple[Any, ...]:
        told = len(self._moments), self._chance
        with going_back(self._case.robot):
            robot = self._robot.snapshot()
        return self._core.snapshot(), robot, told

    def _restore(self, snapshot: tuple[Any, ...]) -> None:
        core, robot, (moments, self._chance) = snapshot
        del self._moments[moments:]
        self._fault = None
        self._core.restore(core)
        with going_back(self._case.robot):
            self._robot.restore(robot)


def chance_of(event: Action, legal: Iterable[Action], rate: float) -> float:
    """The logarithm of the probability of an answer of the strategy `random` with this rate.

    It draws what an event is done to, the first argument, and then the event.
    """
    things = Counter(own.arguments[:1] for own in legal)
    if not things:
        return 0.0
    share = 1 - rate if event == NONE else rate / len(things) / things[event.arguments[:1]]
    return log(share) if share > 0 else IMPOSSIBLE
