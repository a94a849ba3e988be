"""The history of a game as its robot was told it, and heeded it."""

from dataclasses import dataclass, field

from benchmarks.games.literals import Literals, Plan, atom
from benchmarks.games.office import Office, State
from benchmarks.games.relevance import RELEVANT, Scene, shown
from testbed.protocol import Decision, Percept


@dataclass
class Moment:
    """What there is to explain of one step.

    `observed` are literals, `goal` is whether the goal was said to hold; `attempt` is the robot's
    physical action, `happened` whether it took effect; `reports` are the events that are said to
    have happened. `started` is the plan of an activity that was started; None: none was.
    """

    observed: Literals = ()
    goal: bool | None = None
    attempt: str | None = None
    happened: bool = False
    reports: frozenset[str] = frozenset()
    started: Plan | None = None
    stopped: bool = False


@dataclass(frozen=True)
class Rules:
    """What a robot's history depends on beside what happens: by the configuration of the game.

    Robots with `intentions` select their goal at step 0, at which therefore nothing happens, and
    heed what they are told of the goal.
    """

    office: Office
    goal: tuple[str, ...]
    knows_all: bool
    intentions: bool
    relevance: str

    @property
    def since(self) -> int:
        """The first step at which an event may have happened."""
        return int(self.intentions)


@dataclass
class Told:
    """A history up to `step`; it grows by percepts and decisions.

    `changed` is the first step of which the last percept told anything new; `believed` and `ahead`
    are the state and the plan that the robot had in mind after its last decision.
    """

    rules: Rules
    known: Literals
    step: int = 0
    changed: int = 0
    moments: dict[int, Moment] = field(default_factory=dict)
    believed: State | None = None
    ahead: Plan = ()

    @classmethod
    def beginning(cls, rules: Rules, state: State) -> "Told":
        """With what is known of the state at step 0: all of it, or what is seen."""
        return cls(rules, rules.office.known(state, rules.knows_all))

    def at(self, step: int) -> Moment:
        """What is recorded of a step; made when it is first asked for."""
        return self.moments.setdefault(step, Moment())

    def hear(self, percept: Percept) -> None:
        """What a percept adds."""
        self.changed = before = percept.step - 1
        if self.at(before).attempt is not None:
            self.at(before).happened = bool(percept.happened)
        if percept.goal_holds is not None and self.rules.intentions:
            self.at(before).goal = percept.goal_holds
        if percept.happened:
            self.ahead = self.ahead[1:]
        for event in percept.events:
            self.at(event.step).reports |= {str(event.action)}
            self.changed = min(self.changed, event.step)
        self.step = percept.step
        self.at(self.step).observed = self._heeded(percept)

    def decide(self, decision: Decision, believed: State | None) -> None:
        """What a decision in a believed state adds; one that reached a limit adds nothing."""
        trace, moment = decision.trace, self.at(decision.step)
        if trace.mental is not None and trace.mental.name == "start":
            moment.started = tuple(map(str, trace.plan))
        moment.stopped = trace.mental is not None and trace.mental.name == "stop"
        if decision.action not in ("wait", "finish"):
            moment.attempt = str(decision.action)
        if trace.intention is not None:
            self.believed = believed
            self.ahead = tuple(map(str, trace.plan))

    def plan_at(self, step: int) -> Plan:
        """The plan of the activity that was started last before a step."""
        started = (self.moments[i].started for i in range(step - 1, 0, -1) if i in self.moments)
        return next((plan for plan in started if plan is not None), ())

    def _heeded(self, percept: Percept) -> frozenset[str]:
        """The visible literals that enter the history: the attempt's outcome, and the relevant."""
        rules, attempt = self.rules, percept.attempted
        visible = frozenset(map(str, percept.visible))
        wanted = shown(attempt, visible)
        if rules.intentions:
            wanted |= RELEVANT[rules.relevance](
                Scene(rules.office, rules.goal, self.believed, attempt, self.ahead)
            )
        return frozenset(literal for literal in visible if atom(literal) in wanted)
