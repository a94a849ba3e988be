"""What a person who plays an agent is shown at a step, and is asked."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from agents.adversary import AdversaryView
from asp.language import Action, Fluent
from testbed.environment import Core
from testbed.environment.rendering import Stage, draw_text
from testbed.experiment.narration import Narrator
from testbed.experiment.stories import StoryStep
from testbed.experiment.storyteller import Moment, Storyteller
from testbed.play.asking import Asker
from testbed.play.menu import Choice
from testbed.protocol import FINISH, NONE, WAIT, Decision, Percept, RobotClient, Task
from testbed.text import Say, columns
from testbed.world import World


class Board:
    """Draws what is true, and what both agents did at the step before."""

    def __init__(self, core: Core, say: Say) -> None:
        self._stage, self._say = Stage(core.world.description, core.robot), say

    def show(self, step: int, true: Iterable[Fluent], robot: str, adversary: str = "") -> None:
        """Say the picture of a step."""
        still = self._stage.still(true)
        drawn = replace(still, step=step, robot=robot, adversary=adversary)
        self._say("")
        for line in draw_text(drawn, columns()).split("\n"):
            self._say(line)


class Mind(Narrator):
    """Tells a robot's mind below a picture, which shows the step and the world."""

    def _head(self, _step: StoryStep) -> Iterator[str]:
        yield from ()

    def _state(self, _step: StoryStep) -> Iterator[str]:
        yield from ()


class Overheard(RobotClient):
    """A client of whose last question and answer the other side may know."""

    def __init__(self, client: RobotClient) -> None:
        self._client = client
        self.last: tuple[Percept, Decision] | None = None

    def begin(self, task: Task) -> None:
        """As the client."""
        self._client.begin(task)

    def ask(self, percept: Percept) -> Decision:
        """As the client."""
        decision = self._client.ask(percept)
        self.last = percept, decision
        return decision

    def close(self) -> None:
        """As the client."""
        self._client.close()


class AdversaryAtKeyboard:
    """Shows the world and the robot's mind, and asks for an event."""

    def __init__(
        self, core: Core, robot: Overheard, teller: Storyteller, asker: Asker, say: Say
    ) -> None:
        self._robot, self._teller, self._asker = robot, teller, asker
        self._bits = {fluent: 1 << number for number, fluent in enumerate(core.world.fluents)}
        self._board, self._mind, self._say = Board(core, say), Mind(say), say
        self._numbers = {event: number for number, event in enumerate(core.adversary_actions)}
        self._before: tuple[str, str] = "", ""

    def watch(self, moment: Moment) -> None:
        """Take notice of what became of a step."""
        self._before = attempt(moment.decision.action, moment.happened), moment.event or ""

    def __call__(self, view: AdversaryView) -> Action:
        """The event that the person chooses, or `none` where there is no choice."""
        self._board.show(view.step, view.state, *self._before)
        self._tell_mind(sum(map(self._bits.__getitem__, view.state)))
        legal = [Choice(self._numbers[event], event) for event in view.legal]
        if view.left.budget is not None:
            self._say(f"  budget       {view.left.budget} left")
        self._say("")
        if len(legal) > 1:
            return self._asker.ask(legal)
        self._say("nothing can happen at this step")
        return NONE

    def _tell_mind(self, state: int) -> None:
        assert self._robot.last is not None, "a robot decides before the adversary"
        percept, decision = self._robot.last
        told = self._teller.tell(Moment(percept, decision, None, None, state, state))
        self._mind.tell(told)


class RobotAtKeyboard:
    """Shows the world as far as the robot has seen it, and asks for an action."""

    def __init__(self, core: Core, asker: Asker, say: Say) -> None:
        self._world, self._actions, self._asker = core.world, core.robot_actions, asker
        self._board, self._say = Board(core, say), say
        self._memory: int | None = None

    def __call__(self, task: Task, percept: Percept) -> Action:
        """The action that the person chooses."""
        if self._memory is None:
            self._memory = remembered(self._world, 0, task.initial)
        self._memory = seen(self._world, self._memory, percept)
        attempted = attempt(percept.attempted or "", percept.happened)
        self._board.show(percept.step, self._world.true_atoms(self._memory), attempted)
        for line in _news(percept):
            self._say(f"  told         {line}")
        self._say("")
        return self._asker.ask([*self._choices(self._memory)])

    def _choices(self, state: int) -> Iterator[Choice]:
        """All actions; first those against which nothing is known."""
        notes = {own: self._why_not(state, own) for own in self._actions}
        for number, own in sorted(enumerate(self._actions), key=lambda each: bool(notes[each[1]])):
            yield Choice(number, own, notes[own])

    def _why_not(self, state: int, action: Action) -> str:
        """The law that makes an action impossible in what is remembered; "" if none does."""
        physical = action not in (WAIT, FINISH)
        return (self._world.why_not(state, (action,)) or "") if physical else ""


def attempt(action: str, happened: bool | None) -> str:
    """What a robot did, as the caption of a picture."""
    return f"{action} failed" if happened is False else action


def remembered(world: World, state: int, literals: Iterable[Fluent]) -> int:
    """The state in which the literals hold, and else as much as possible of this one."""
    return next(iter(world.adjusted(state, literals)), state)


def seen(world: World, state: int, percept: Percept) -> int:
    """What a state is remembered as after the attempt, and with what is seen, of a percept."""
    after: tuple[int, ...] = ()
    if percept.happened and percept.attempted is not None:
        after = world.successors(state, (percept.attempted,))
    fitting = (own for own in after if world.satisfies(own, percept.visible))
    expected = next(fitting, next(iter(after), state))
    return remembered(world, expected, percept.visible)


def _news(percept: Percept) -> Iterator[str]:
    yield from (f"{event.action} at step {event.step}" for event in percept.events)
    if percept.goal_holds is False:
        yield "the goal does not hold"
