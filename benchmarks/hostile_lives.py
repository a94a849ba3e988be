"""Games of the office against a besieger, with a robot whose decisions are timed and compared."""

import copy
import random
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from agents.adversary import AdversaryView, Game
from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Intention
from asp.language import Action, Literal
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import Diagnosis, Explanation
from asp.solving import LimitError, Limits, deciding
from benchmarks.offices import book_names, room_names
from benchmarks.problems import delivered
from benchmarks.sheets import DisagreementError
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import NONE, Decision, Percept, Plans, Task
from testbed.world import load_world, world_of

EVERY = 4
REFERENCE = Limits(seconds=60.0, conflicts=50_000)
COMPARED = 64
"""The last step at which the reference is asked: later on its conflicts do not suffice."""


def _told(how: str) -> list[str]:
    return [f"observability.{event}={{{how}}}" for event in ("exo_move", "exo_lock")]


_SEEN = "knowledge=seen"
VARIANTS: Mapping[str, Sequence[str]] = {
    "complete": (),
    "partial": (_SEEN,),
    "distrusted": _told("mode: always, probability: 0.5, false_reports: 0.1"),
    "late": _told("mode: always, probability: 0.7, delay: 8"),
    "all": (_SEEN, *_told("mode: always, probability: 0.7, false_reports: 0.05, delay: 8")),
}
"""What the robot knows of the start, and what it is told of events."""


class Besieger:
    """Does something at random at every so many steps, and whenever the goal would be achieved.

    What it does is such that the goal does not hold afterwards, and that it can be undone again.
    """

    @dataclass(frozen=True)
    class Options:
        """`every`: steps from one event to the next."""

        every: int = EVERY

    sees = ("state", "robot_action")

    def __init__(self, game: Game, options: Options) -> None:
        self._world, self._goal, self._every = world_of(game.description), game.goal, options.every
        self._own = game.description.agent_actions
        self.reset(0)

    def reset(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)

    def act(self, view: AdversaryView) -> Action:
        state = self._world.state(view.state)
        own = self._effective(state, view.robot_action)
        if view.step % self._every and not self._achieves(state, own):
            return NONE
        events = [event for event in view.legal if event != NONE]
        drawn = [events[int(place)] for place in self._random.permutation(len(events))]
        undoing = [event for event in drawn if not self._achieves(state, (*own, event))]
        lasting = (event for event in undoing if self._lasts(state, (*own, event)))
        return next(lasting, next(iter(undoing), NONE))

    def _effective(self, state: int, action: Action | None) -> tuple[Action, ...]:
        possible = action in self._own and self._world.executable(state, [action])
        return (action,) if action is not None and possible else ()

    def _achieves(self, state: int, actions: Sequence[Action]) -> bool:
        return self._world.satisfies(self._world.successor(state, actions), self._goal)

    def _lasts(self, state: int, actions: Sequence[Action]) -> bool:
        """Whether what the robot may achieve next can be undone at once."""
        after, world = self._world.successor(state, actions), self._world
        return all(
            any(
                world.executable(after, [own, event]) and not self._achieves(after, (own, event))
                for event in world.exogenous_actions
            )
            for own in self._own
            if world.executable(after, [own]) and self._achieves(after, (own,))
        )


@dataclass(frozen=True)
class Moment:
    """A decision: its process time (ms), that of grounding in it, and the size of what it assumes.

    `adopted`: it adopted an explanation; `cut`: its budget was used up.
    """

    step: int
    ms: float
    grounding_ms: float
    size: int
    adopted: bool
    cut: bool


@dataclass
class Life:
    """The decisions of a game, and of how many the reference was asked, and gave an answer."""

    moments: list[Moment] = field(default_factory=list)
    asked: int = 0
    answered: int = 0


class Watched:
    """An intentional robot with a clock; the reference may be asked what it explains anew."""

    def __init__(self, life: Life, compares: bool) -> None:
        self._life = life
        self._explanation = Explanation()
        self._robot = IntentionalRobot(self._reasoner)
        self._compares = compares
        self._compared_ms = 0.0

    def begin(self, task: Task) -> None:
        self._robot.begin(task)

    def act(self, percept: Percept) -> Decision:
        self._compared_ms = 0.0
        began = time.process_time()
        decision = self._robot.act(percept)
        ms = (time.process_time() - began) * 1e3 - self._compared_ms
        trace, held = decision.trace, self._explanation
        cut = trace.intention is None or not held.proved
        grounding = trace.preparation_cpu_s * 1e3
        adopted = trace.explanation is not None
        self._life.moments.append(Moment(percept.step, ms, grounding, held.size, adopted, cut))
        return decision

    def _reasoner(
        self, knowledge: Knowledge, goal: tuple[Literal, ...], limit: int, plans: Plans
    ) -> "Watched":
        self._fast = IncrementalReasoner(knowledge, goal, limit, plans)
        self._reference = ReferenceReasoner(knowledge, goal, limit, plans)
        return self

    def diagnose(self, history: History, adopted: Explanation) -> Diagnosis:
        found = self._fast.diagnose(history, adopted)
        self._explanation = found.explanation
        is_new = found.explanation != adopted.left(history)
        if self._compares and is_new and history.step <= COMPARED:
            began = time.process_time()
            self._compare(copy.deepcopy(history), adopted)
            self._compared_ms = (time.process_time() - began) * 1e3
        return found

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        return self._fast.intend(history, explained)

    def _compare(self, history: History, adopted: Explanation) -> None:
        """Asks the reference. Raises DisagreementError where it proves something else."""
        self._life.asked += 1
        try:
            with deciding(REFERENCE):
                theirs = self._reference.diagnose(history, adopted).explanation
        except LimitError:
            return
        if theirs.proved:
            self._life.answered += 1
            if theirs != self._explanation:
                raise DisagreementError(f"step {history.step}: {theirs}, {self._explanation}")


def games(relevance: str, variant: str, number: int, steps: int) -> list[TrialSpec]:
    """So many games, which last so many steps, each with a goal and a beginning that are drawn."""
    draw, rooms = random.Random(number), room_names(4)
    world = load_world("office")
    found: list[TrialSpec] = []
    while len(found) < number:
        goal = [
            literal for book in book_names(2) for literal in delivered([book], draw.choice(rooms))
        ]
        overrides = [
            *VARIANTS[variant],
            f"relevance={relevance}",
            f"goal=[{','.join(goal)}]",
            f"seed={len(found)}",
            f"limits.steps={steps}",
            "robots=[intentional]",
            "link=inprocess",
            "limit=1",
            "scenarios=null",
            "exogenous_while_thinking=true",
            "adversary.strategy=benchmarks.hostile_lives:Besieger",
        ]
        (spec,) = plan_trials(load_config("office", overrides))
        if not world.satisfies(world.state(spec.initial), goal):
            found.append(spec)
    return found


def play(spec: TrialSpec, compares: bool = False) -> Life:
    """The life of a robot in a game. Raises RuntimeError if the trial failed."""
    life = Life()
    result = play_trial(spec, InProcessRobot(lambda _: Watched(life, compares)))
    if result.details is not None or result.record.outcome == "error":
        raise RuntimeError(result.details or result.record.reason)
    return life
