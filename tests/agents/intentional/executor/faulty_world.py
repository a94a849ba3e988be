"""A fine world in which everything goes as it should, except for the faults that a test injects."""

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from asp.language import Literal
from asp.refinement import Refinement, sensing_of
from testbed.protocol import Decision, Event, FineTrace, Percept, Robot, Task
from testbed.world import world_of
from tests.literals import parsed

Nth = tuple[str, int]
"""An action or test, and the how-manieth time it is made, from 1."""


@dataclass(frozen=True)
class Faults:
    """Tests that are answered wrongly, actions without effect, events beside actions.

    Of an event in `reported` the robot is told in the percept that follows; where the news is
    `false`, nothing happened.
    """

    lies: Collection[Nth] = ()
    slips: Collection[Nth] = ()
    events: Mapping[Nth, str] = field(default_factory=dict)
    reported: bool = False
    false: bool = False


NO_FAULTS = Faults()


@dataclass(frozen=True)
class Play:
    """How a trial went: the decisions with the percepts they answer, and how it ended."""

    percepts: Sequence[Percept]
    decisions: Sequence[Decision]
    achieved: bool
    finished: bool

    @property
    def fine(self) -> list[FineTrace]:
        return [d.trace.fine for d in self.decisions if d.trace.fine is not None]

    @property
    def actions(self) -> list[str]:
        """The concrete physical actions."""
        own = (decision.action for decision in self.decisions)
        return [a for a in own if not a.startswith("test_") and a not in ("wait", "finish")]

    @property
    def abstract(self) -> list[tuple[str, bool | None]]:
        """The abstract actions that came to an end."""
        return [(trace.ended, trace.happened) for trace in self.fine if trace.ended]

    @property
    def committed(self) -> list[str]:
        return [literal for trace in self.fine for literal in trace.committed]


def play(
    robot: Robot,
    refinement: Refinement,
    start: Sequence[str],
    goal: Sequence[str],
    faults: Faults = NO_FAULTS,
    steps: int = 400,
) -> Play:
    """Plays a trial that begins in the fine state with these true fluents."""
    world, goal = world_of(refinement), parsed(goal)
    faulty = _FaultyWorld(refinement, faults, world.state(parsed(start)))
    robot.begin(_task(refinement, faulty.state, goal))
    percept, percepts, decisions = faulty.percept(1, ()), list[Percept](), list[Decision]()
    wrong = False
    while percept.step < steps:
        percepts.append(percept)
        decision = robot.act(percept)
        decisions.append(decision)
        if decision.action == "finish":
            achieved = world.satisfies(faulty.state, goal)
            if achieved or wrong:
                return Play(percepts, decisions, achieved, True)
            percept = faulty.percept(percept.step + 1, (), goal_holds=False)
        else:
            percept = faulty.advance(percept.step, decision.action)
        wrong = decision.action == "finish"
    return Play(percepts, decisions, world.satisfies(faulty.state, goal), False)


class _FaultyWorld:
    def __init__(self, refinement: Refinement, faults: Faults, state: int) -> None:
        self._world = world_of(refinement)
        self._sensing = sensing_of(refinement)
        self._robot = refinement.description.robots[0]
        self._faults = faults
        self._made: Counter[str] = Counter()
        self.state = state

    def advance(self, step: int, action: str) -> Percept:
        """Plays a step and makes the percept after it."""
        self._made[action] += 1
        nth = (action, self._made[action])
        is_test = action.name in self._sensing.names
        possible = not is_test and action != "wait" and nth not in self._faults.slips
        effective = [action] if possible and self._world.executable(self.state, [action]) else []
        event = self._faults.events.get(nth)
        events = [] if event is None else [Literal.parse(event)]
        happening = [] if self._faults.false else events
        self.state = self._world.successor(self.state, [*effective, *happening])
        seen = self._outcome(nth) if is_test else ()
        told = [Event(step=step, action=e) for e in events if self._faults.reported]
        attempt = None if action == "wait" else (action, bool(effective or seen))
        return self.percept(step + 1, seen, told, attempt=attempt)

    def percept(
        self,
        step: int,
        seen: Iterable[str],
        events: Sequence[Event] = (),
        goal_holds: bool | None = None,
        attempt: tuple[str, bool] | None = None,
    ) -> Percept:
        attempted, happened = attempt or (None, None)
        return Percept(
            trial="play",
            step=step,
            visible=[*seen, *self._world.visible(self.state, self._robot)],
            attempted=attempted,
            happened=happened,
            events=list(events),
            goal_holds=goal_holds,
        )

    def _outcome(self, nth: Nth) -> tuple[str, ...]:
        test, _ = nth
        if not self._sensing.can(test, self._world.facts(self.state)):
            return ()
        fluent = self._sensing.fluent(test)
        holds = self._world.satisfies(self.state, [fluent]) != (nth in self._faults.lies)
        return (fluent if holds else fluent.complement,)


def _task(refinement: Refinement, state: int, goal: Sequence[str]) -> Task:
    world, robot = world_of(refinement), refinement.description.robots[0]
    true = frozenset(world.true_atoms(state))
    own = [f for f in world.true_atoms(state) if robot in f and f.startswith("fine_")]
    fluents = refinement.description.fluents
    return Task(
        trial="play",
        robot="intentional",
        domain="faulty",
        source=refinement.coarse.text,
        goal=list(goal),
        initial=[f if f in true else f.complement for f in fluents],
        plan_limit=20,
        seed=0,
        refinement=_fine_text(refinement),
        initial_fine=own,
    )


TEXTS: dict[Refinement, str] = {}
"""The text of a refinement, which it does not hold itself."""


def _fine_text(refinement: Refinement) -> str:
    return TEXTS[refinement]
