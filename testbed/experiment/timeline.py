"""A record in words: where its trial stands, its explanations, and the trial step by step."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from markupsafe import Markup

from asp.language import Action, Literal
from testbed.experiment.record import COARSE, Attempt, Explained, Occurrence, Rejected, TrialRecord
from testbed.protocol import WAIT, Explanation

_TRIAL = Markup(
    "<table><caption>{caption}</caption><thead><tr><th>step</th><th>robot</th><th>others</th>"
    "<th>explained by</th></tr></thead><tbody>{rows}</tbody></table>"
)
_ROW = Markup(
    "<tr><td>{0.number}</td><td>{0.robot}</td><td>{0.others}</td><td>{0.explained}</td></tr>"
)


@dataclass(frozen=True)
class Step:
    """What a record has of a step; `kind` is how it is coloured."""

    number: int
    attempt: Attempt | None
    mental: Action | None
    event: Occurrence | None
    rejected: Sequence[Rejected]
    explained: Explained | None

    @property
    def kind(self) -> str:
        """Whether the robot acted, and whether that took effect."""
        return kind_of(None if self.attempt is None else self.attempt.happened)

    @property
    def is_empty(self) -> bool:
        """Whether nothing begins at it or is heard of."""
        own = (self.attempt, self.mental, self.event, self.explained)
        return not self.rejected and all(one is None for one in own)


@dataclass(frozen=True)
class Row:
    """A step as a row of a table."""

    number: int
    kind: str
    robot: str
    others: str
    explained: str


def kind_of(happened: bool | None) -> str:
    """The kind of a step from whether its physical action, if any, took effect."""
    return "mental" if happened is None else "done" if happened else "failed"


def steps_of(record: TrialRecord) -> Iterator[Step]:
    """The steps of a trial."""
    attempts = {own.step: own for own in record.actions}
    mental = {own.step: own.action for own in record.mental}
    events = {own.step: own for own in record.exogenous}
    explanations = {own.step: own for own in record.explanations}
    for number in range(1, record.steps + 1):
        yield Step(
            number,
            attempts.get(number),
            mental.get(number),
            events.get(number),
            [own for own in record.rejected if own.step == number],
            explanations.get(number),
        )


def timeline(record: TrialRecord) -> Iterator[Row]:
    """The steps of a trial: what the robot did, what others did, what the robot explained.

    At the fine resolution those alone at which something begins or is heard of.
    """
    for step in steps_of(record):
        if record.fine is None or not step.is_empty:
            told = explanation(step.explained) if step.explained else ""
            yield Row(step.number, step.kind, _robot(step), ", ".join(_others(step)), told)


def _robot(step: Step) -> str:
    if step.attempt is None:
        return str(step.mental or WAIT)
    return f"{step.attempt.action}{'' if step.attempt.happened else ' failed'}"


def _others(step: Step) -> Iterator[str]:
    if step.event is not None:
        yield f"{step.event.action}{'' if step.event.observed else ', unseen'}"
    yield from (f"{own.action}, not possible" for own in step.rejected)


def html_of(record: TrialRecord) -> str:
    """The record as a table in HTML."""
    where = of_place(record.scenario, record.level)
    outcome = in_words(record.outcome) + (f": {record.reason}" if record.reason else "")
    goal = ", ".join(record.goal)
    caption = f"{record.trial}: {record.robot} in {record.domain}, {where}; goal: {goal}; {outcome}"
    rows = Markup("").join(_ROW.format(step) for step in timeline(record))
    return str(_TRIAL.format(caption=caption, rows=rows))


def place(scenario: str, level: str) -> str:
    """What a trial is listed under: its scenario, or at the fine resolution its level."""
    return scenario if level == COARSE else level


def of_place(scenario: str, level: str) -> str:
    """The same with the word for it."""
    return f"scenario {scenario}" if level == COARSE else f"level {level}"


def in_words(name: str) -> str:
    """A name of the record as text: `false_finish` is `false finish`."""
    return name.replace("_", " ")


def exception(literal: Literal) -> str:
    """What holds at step 0 against a default."""
    return f"exception {literal}"


def explanation(told: Explanation | Explained) -> str:
    """An explanation as text: how it began, what others did, what is distrusted, other outcomes."""
    events = [f"{event.action} at step {event.step}" for event in told.unobserved]
    false = [f"distrusted {event.action} at step {event.step}" for event in told.distrusted]
    other = [f"another outcome of {own.action} at step {own.step}" for own in told.outcomes]
    assumed = [*map(exception, told.exceptions), *events, *false, *other]
    return ", ".join(assumed) or "nothing unobserved"
