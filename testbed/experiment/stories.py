"""The story of a trial: the world and the robot's mind step by step, in a form that can be kept.

A story has what a replay tells, so that a trial can be shown without being played again. What is as
at the step before is not kept again: the world is told by its changes.
"""

from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import msgspec

from asp.language import Action, Fluent, Literal
from testbed.experiment.growing_file import GrowingFile
from testbed.experiment.record import At
from testbed.experiment.run_folder import STORIES
from testbed.protocol import Contradiction, Count, Explanation, NoPlan, literal_within_bounds

MOST_BYTES = 4 * 2**20
"""Of one story as a line; of one that is longer no steps are kept."""
MOST_STEPS = 200_000
"""More of the shortest steps than a line has room for."""
START = b'{"trial":"'
"""How a line begins, before the id of its trial."""


class FineStep(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """How an abstract action is carried out, at one step of it; names are those of `FineTrace`.

    `observed` are the literals that the robot saw, `wrong` those of them that do not hold.
    """

    abstract: Action | None = None
    begun: Count | None = None
    zoomed: list[str] = []
    plan: list[Action] = []
    observed: list[Literal] = []
    wrong: list[Literal] = []
    committed: list[Literal] = []
    failed: str = ""
    ended: Action | None = None
    happened: bool | None = None
    inferred: list[Literal] = []


class StoryStep(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """One step of a trial: the world, what the robot was told, thought and answered, what came.

    `action` is the robot's answer, `mental` its `start(N)`, `stop(N)` or `finish`; `happened` is
    None unless it attempted a physical action. `event` is the exogenous action beside it, `skipped`
    are those of a script that were not possible. `told` is the news that reached the robot before
    it answered, `goal_holds` is False where it was told that the goal does not hold. `gives_up`
    says that it finished without believing that the goal holds.

    `world` are the literals that do not hold at the step before; at the first step the atoms that
    are true. `mistaken` is what the robot has wrong: an atom that is true, and that it does not
    believe; `-atom` where it believes one that is false. It is None where the belief is not
    reported. The rest is as in `Trace`. At the fine resolution the belief is of the coarse one, and
    `fine` has the rest.
    """

    step: Annotated[int, msgspec.Meta(ge=0, le=MOST_STEPS)]
    action: Action
    mental: Action | None = None
    happened: bool | None = None
    gives_up: bool = False
    event: Action | None = None
    skipped: list[Action] = []
    told: list[At] = []
    goal_holds: bool | None = None
    world: list[Literal] = []
    mistaken: list[Literal] | None = None
    unheeded: list[Literal] = []
    contradictions: list[Contradiction] = []
    explanation: Explanation | None = None
    alternatives: list[Explanation] = []
    more_alternatives: bool = False
    intention: Action | None = None
    plan: list[Action] = []
    reason: str = ""
    no_plan: NoPlan | None = None
    fine: FineStep | None = None


class Story(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The story of a trial, up to its last step. `end` are the literals that came to hold by it."""

    trial: str
    steps: list[StoryStep] = []
    end: list[Literal] = []

    def states(self) -> Iterator[frozenset[Fluent]]:
        """The atoms that are true at each step, and after the last one."""
        true: frozenset[Fluent] = frozenset()
        for changes in (*(step.world for step in self.steps), self.end):
            true = applied(true, changes)
            yield true


def applied(true: frozenset[Fluent], changes: list[Literal]) -> frozenset[Fluent]:
    """The true atoms after these literals came to hold."""
    gone = {literal.complement for literal in changes if not literal.is_positive}
    return true.difference(gone).union(literal for literal in changes if literal.is_positive)


def believed(true: frozenset[Fluent], mistaken: list[Literal]) -> frozenset[Fluent]:
    """The atoms that the robot believes, of those that are true and what it has wrong."""
    return applied(true, [literal.complement for literal in mistaken])


# Made here: msgspec reads what a type holds when it first needs it, and two threads that do so at
# once end the interpreter.
_decoder = msgspec.json.Decoder(Story, dec_hook=literal_within_bounds)


def encode(story: Story) -> bytes:
    """The story as one line of JSON, newline included; without its steps where that is too long."""
    line = msgspec.json.encode(story, enc_hook=str) + b"\n"
    return line if len(line) <= MOST_BYTES else encode(Story(trial=story.trial))


def decode(line: bytes) -> Story:
    """The story in a line. Raises msgspec.DecodeError for anything else, and where a step lacks."""
    try:
        story = _decoder.decode(line)
    except (UnicodeDecodeError, RecursionError) as error:
        raise msgspec.DecodeError(str(error)) from error
    for step, following in pairwise(story.steps):
        if following.step != step.step + 1:
            raise msgspec.DecodeError(f"after step {step.step} comes step {following.step}")
    return story


def story_lines(folder: Path) -> Iterator[tuple[str, bytes]]:
    """The lines of a run's stories, each with the id of its trial, none of them decoded.

    What is no such line is left out, as is a torn last one; without the file there are none.
    """
    path = folder / STORIES
    if not path.is_file():
        return
    with path.open("rb") as file:
        for line in file:
            trial = trial_of(line)
            if trial is not None and line.endswith(b"\n"):
                yield trial, line


def trial_of(line: bytes) -> str | None:
    """The id of the trial whose story a line is, not decoded; None of another line."""
    end = line.find(b'"', len(START))
    return line[len(START) : end].decode("utf-8", "replace") if line.startswith(START) else None


class StoryFile:
    """The stories of a run folder, of which each is read when it is asked for.

    `look` reads on where another process wrote more. Of a trial that was played again it is the
    last story; lines are not decoded before they are asked for.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / STORIES
        self._lines, self._places = GrowingFile(self._path), dict[str, int]()
        self.look()

    def look(self) -> None:
        """Find the stories that have come since the last look."""
        for place, line in self._lines.new_lines():
            if (trial := trial_of(line)) is not None:
                self._places[trial] = place

    def __contains__(self, trial: str) -> bool:
        """Whether there is a line for the story of a trial."""
        return trial in self._places

    def get(self, trial: str) -> Story | None:
        """The story of a trial; None where there is none, or it is damaged."""
        if trial not in self._places or not self._path.is_file():
            return None
        with self._path.open("rb") as file:
            file.seek(self._places[trial])
            story = _whole(file.readline(MOST_BYTES))
        # Of a file that was replaced since the last look another story may stand there.
        return story if story is not None and story.trial == trial else None

    def of(self, trials: Iterable[str]) -> dict[str, Story]:
        """The stories of those of the trials that have one, by trial and in the order given."""
        told = ((trial, self.get(trial)) for trial in trials)
        return {trial: story for trial, story in told if story is not None}


def is_whole(line: bytes) -> bool:
    """Whether a line is that of a story."""
    return line.endswith(b"\n") and _whole(line) is not None


def _whole(line: bytes) -> Story | None:
    try:
        return decode(line)
    except msgspec.DecodeError:
        return None
