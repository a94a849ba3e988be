"""Playing games with checks, and shortening the stories of their faults."""

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from benchmarks.games.checking import Checker
from benchmarks.games.drawing import Game, smaller
from benchmarks.games.faults import Fault
from benchmarks.sheets import Row
from testbed.experiment.robots import make_robot
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Robot

MakeRobot = Callable[[str], Robot]
MOST_TRIED = 300
"""Games that are played to shorten one story."""


@dataclass
class Story:
    """A game as it was played, with the faults of its first decision that has any."""

    game: Game
    moments: list[Moment] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)
    outcome: str = ""

    def __str__(self) -> str:
        lines = [str(self.game), f"    {self.game.initial} -> {self.game.goal}"]
        for moment in self.moments:
            percept, trace = moment.percept, moment.decision.trace
            did = trace.intention or moment.decision.action
            parts = [f"{percept.step:4} {did}", "" if moment.happened is not False else "fails"]
            parts += [f"told of {each.action} at {each.step}" for each in percept.events]
            parts += ["told that the goal does not hold"] * (percept.goal_holds is False)
            if trace.explanation is not None:
                parts.append(
                    f"explains: {[(e.step, str(e.action)) for e in trace.explanation.unobserved]}"
                )
            parts += [f"unseen: {moment.event}"] * (moment.event is not None)
            lines.append("; ".join(filter(None, parts)))
        return "\n".join([*lines, f"    {self.outcome}", *(f"!!! {each}" for each in self.faults)])


def play(game: Game, make: MakeRobot = make_robot) -> Story:
    """Plays a game, and checks it up to the first decision that has a fault."""
    checker, story = Checker(game), Story(game)

    def watch(moment: Moment) -> None:
        if not story.faults:
            story.moments.append(moment)
            story.faults += checker.check(moment.percept, moment.decision)

    record = play_trial(game.spec, InProcessRobot(make), watch).record
    story.outcome = f"{record.outcome}: {record.reason}"
    if not story.faults:
        story.faults += _judged(game, record.minimal_actions, record.minimal_reason)
        if record.outcome in ("error", "robot_lost"):
            story.faults.append(Fault("outcome", record.steps, story.outcome))
    return story


def _judged(game: Game, least: int | None, reason: str | None) -> Iterable[Fault]:
    """The judge of trials knows the fewest actions, too, if it may search for them."""
    if reason == "budget":
        return
    expected = game.office.distances(game.goal).get(game.state)
    if least != expected or (reason == "no plan") != (expected is None):
        yield Fault("plan", 0, f"the judge says {least} ({reason}); at least {expected} actions")


def shortened(story: Story, make: MakeRobot = make_robot) -> Story:
    """The story of a smaller game that fails in the same check, and of which none is smaller."""
    check, tried, waiting = story.faults[0].check, 0, smaller(story.game)
    while waiting and tried < MOST_TRIED:
        tried += 1
        found = play(waiting.pop(0), make)
        if any(fault.check == check for fault in found.faults):
            story, waiting = found, smaller(found.game)
    return story


@dataclass
class Tally:
    """What was played and checked, and what was `found`."""

    found: list[Story] = field(default_factory=list)
    counts: dict[str, Counter[str]] = field(default_factory=dict)

    def add(self, story: Story) -> None:
        """Counts a game."""
        traces = [moment.decision.trace for moment in story.moments]
        self.counts.setdefault(story.game.robot, Counter()).update(
            games=1,
            decisions=len(traces),
            explanations=sum(trace.explanation is not None for trace in traces),
            plans=max((trace.plans for trace in traces), default=0),
            stopped=sum(trace.futile_at is not None for trace in traces),
            given_up=sum(trace.no_plan is not None for trace in traces),
            at_a_limit=sum(trace.intention is None for trace in traces),
        )

    @property
    def rows(self) -> list[Row]:
        """A row per robot, and one for all."""
        total = Counter[str]()
        for own in self.counts.values():
            total.update(own)
        each = {**dict(sorted(self.counts.items())), "all": total}
        return [{"robot": name, **own} for name, own in each.items()]

    def __str__(self) -> str:
        games, decisions = (self.rows[-1][key] for key in ("games", "decisions"))
        return f"{games} games, {decisions} decisions: {len(self.found) or 'nothing'} found"
