"""Games at the fine resolution, whose coarse decisions are held against the same brute force.

What the coarse robot is told follows from what was inferred in cells and parts, and is checked as
it is told: actions and tests are certain, and everything is heeded, so that no book is left out.
"""

from collections.abc import Iterable, Iterator

from agents.intentional.controller import IntentionalRobot
from agents.intentional.refined import RefinedRobot
from benchmarks.games.checking import Checker
from benchmarks.games.drawing import Game
from benchmarks.games.faults import Fault
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept, Robot, Task

GAMES = {"small": 8, "full": 250}
_KEYS = (
    "levels=[]",
    "refinement=office.fine",
    "draw.goal=[loc(book,room)]",
    "robots=[intentional]",
    "relevance=all",
    "statistics={}",
    "limits.steps=400",
    "limit=1",
)


class Checked:
    """A coarse robot, and the faults of its first decision that has any."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.faults: list[Fault] = []

    def begin(self, task: Task) -> None:
        self._robot.begin(task)
        initial = tuple(sorted(str(each) for each in task.initial if each.is_positive))
        goal, options = tuple(map(str, task.goal)), {"relevance": task.relevance}
        game = Game("intentional", "office", initial, goal, script=(), steps=0, options=options)
        self._checker = Checker(game)

    def act(self, percept: Percept) -> Decision:
        decision = self._robot.act(percept)
        if not self.faults:
            self.faults += self._checker.check(percept, decision)
        return decision


def play(seed: int, robot: Robot | None = None) -> list[Fault]:
    """Plays the game of a seed; the faults that are found in decisions of the coarse robot."""
    (spec,) = plan_trials(load_config("levels", [*_KEYS, f"seed={seed}"]))
    checked = Checked(robot or IntentionalRobot())
    record = play_trial(spec, InProcessRobot(lambda _: RefinedRobot(checked))).record
    if record.outcome in ("error", "robot_lost"):
        checked.faults.append(Fault("outcome", record.steps, str(record.reason)))
    return checked.faults


def found(seeds: Iterable[int]) -> Iterator[str]:
    """The first fault of each game that has any, with the keys that play the game again."""
    for seed in seeds:
        for fault in play(seed)[:1]:
            yield f"testbed run levels {' '.join(_KEYS)} seed={seed}\n!!! {fault}"
