"""Long lives: a robot whose books are taken away again whenever it is about to be done."""

import copy
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field

from agents.intentional import IntentionalRobot
from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner
from agents.shared import Intention, Reasoner
from asp.language import Action, Literal, parse_description
from asp.reasoning.diagnosis import Diagnosis, Explanation
from benchmarks.measuring import forget, timed
from testbed.environment import Core, Observability, Rules
from testbed.protocol import NONE, Decision, Task
from testbed.world import World, world_of


@dataclass(frozen=True)
class Question:
    """What a reasoner was asked at a step, and what it answered."""

    history: History
    adopted: Explanation
    explained: Diagnosis
    intention: Intention


@dataclass
class Siege:
    """A life in an office: how long each decision took (ms), and some of its questions.

    `copying_ms` is what it took to keep the last question; it is no part of a decision.
    """

    decisions: list[Decision] = field(default_factory=list)
    took_ms: list[float] = field(default_factory=list)
    copying_ms: float = 0.0
    questions: dict[int, Question] = field(default_factory=dict)

    def contradicted(self, index: int) -> bool:
        """Whether the decision explained anew what had been believed."""
        return self.decisions[index].trace.explanation is not None


class Recording:
    """A reasoner that keeps the questions of some steps."""

    def __init__(self, reasoner: Reasoner[History], steps: Collection[int], siege: Siege) -> None:
        self._reasoner = reasoner
        self._steps = steps
        self._siege = siege

    def diagnose(self, history: History, adopted: Explanation) -> Diagnosis:
        self._asked: tuple[History, Explanation] | None = None
        if history.step in self._steps:
            took, copied = timed(lambda: copy.deepcopy(history))
            self._siege.copying_ms += took
            self._asked = copied, adopted
        return self._reasoner.diagnose(history, adopted)

    def intend(self, history: History, explained: Diagnosis) -> Intention:
        intention = self._reasoner.intend(history, explained)
        if self._asked is not None:
            self._siege.questions[history.step] = Question(*self._asked, explained, intention)
        return intention


def besiege(
    source: str,
    initial: Sequence[Literal],
    goal: Sequence[Literal],
    steps: int,
    silent: Collection[int] = (),
    forgetful: Collection[int] = (),
    recorded: Collection[int] = (),
) -> Siege:
    """Plays so many steps. An event undoes part of the goal in each step that would achieve it.

    The robot is told of every event, except of one in place of the first after each step of
    `silent`. At the steps of `forgetful` it has forgotten the answers that it gave before, and
    of `recorded` ones the questions are kept.
    """
    world = world_of(parse_description(source, "office.al"))
    siege = Siege()
    robot = IntentionalRobot(lambda *asked: Recording(IncrementalReasoner(*asked), recorded, siege))
    told, untold = (Core(world, _rules(goal, steps, mode), ()) for mode in ("always", "never"))
    told.reset(seed=0, initial=initial, trial="siege")
    untold.reset(seed=0, initial=initial, trial="siege")
    robot.begin(_task(world, told.situation.state, source, goal))
    pending = sorted(silent, reverse=True)
    while told.situation.ending is None:
        percept = told.percept
        if percept.step in forgetful:
            forget()
        siege.copying_ms = 0.0
        took, decision = timed(lambda percept=percept: robot.act(percept))  # type: ignore[misc]
        siege.took_ms.append(took - siege.copying_ms)
        siege.decisions.append(decision)
        event = _undoing(world, told, decision.action, goal)
        unheard = event != NONE and bool(pending) and percept.step >= pending[-1]
        untold.restore(told.snapshot())
        core = untold if unheard else told
        core.advance(decision.action, event)
        if unheard:
            pending.pop()
            told.restore(untold.snapshot())
    return siege


def _undoing(world: World, core: Core, action: Action, goal: Sequence[Literal]) -> Action:
    """The first event that keeps the action from achieving the goal; none where it does not."""
    state = core.situation.state
    after = world.successors(state, () if action in ("wait", "finish") else (action,))
    if not after or not world.satisfies(after[0], goal):
        return NONE
    for event in core.events(action)[1:]:
        if not world.satisfies(world.successor(state, (action, event)), goal):
            return event
    return NONE


def _rules(goal: Sequence[Literal], steps: int, mode: str) -> Rules:
    seen = Observability(mode, 1.0)  # type: ignore[arg-type]
    return Rules(
        goal=tuple(goal),
        steps=steps,
        observability={"exo_move": seen, "exo_lock": seen},
        goal_feedback=True,
        exogenous_while_thinking=False,
    )


def _task(world: World, state: int, source: str, goal: Sequence[Literal]) -> Task:
    return Task(
        trial="siege",
        robot="intentional",
        domain="office",
        source=source,
        goal=[*map(Literal.parse, goal)],
        initial=list(world.literals(state)),
        plan_limit=30,
        seed=0,
    )
