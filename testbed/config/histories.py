"""Histories that users write down: YAML in, checked for its form and its goal."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from pydantic import Field, ValidationError

from asp.language import Description, analyse, read_text
from asp.reasoning import Step
from testbed.config.checking import goal_findings, goals_of
from testbed.config.composing import compose
from testbed.config.models import GOAL
from testbed.config.places import ConfigError, Places
from testbed.config.values import Flag, Literals, LiteralText, Section
from testbed.config.wording import refusal
from testbed.world import world_of

HISTORY = 'history: [{observed: ["f(a,b)"], attempted: "act(a)"}]'
"""How a history is written."""


class ToldStep(Section):
    """One step, as `Step` has it."""

    observed: Literals = ()
    attempted: LiteralText | None = None
    took_effect: Flag = True
    reported: Literals = ()
    goal: Flag | None = None


class ToldHistory(Section):
    """Steps, and the goal that some of them tell of."""

    goal: Annotated[Literals, Field(examples=[GOAL])] = ()
    history: Annotated[tuple[ToldStep, ...], Field(examples=[HISTORY])]

    @property
    def steps(self) -> Sequence[Step]:
        """The steps, to be explained."""
        return [Step(**dict(told)) for told in self.history]


def read_history(path: Path, description: Description) -> tuple[ToldHistory, Places]:
    """The history of a file, and where everything stands in it; some state satisfies its goal.

    Raises ConfigError, SourceError for what is no text, and OSError.
    """
    text = read_text(path)
    places = Places(path, text, (), "")
    try:
        told = ToldHistory.model_validate(compose(text, (), places))
    except ValidationError as error:
        raise refusal(error, places, ToldHistory) from None
    telling = (i for i, step in enumerate(told.history) if step.goal is not None)
    if not told.goal and (first := next(telling, None)) is not None:
        missing = f"tells of a goal, and none is given; add one, as in {GOAL}"
        raise ConfigError(places.lines([(("history", first, "goal"), missing)]))
    signature = analyse(description.source, f"{description.name}.al")[1]
    goals = goals_of(world_of(description), signature)
    if lines := places.lines(goal_findings(("goal",), told.goal, goals)):
        raise ConfigError(lines)
    return told, places
