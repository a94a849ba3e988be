"""A record in words: where its trial stands, its explanations, and the trial step by step."""

from collections.abc import Iterator
from dataclasses import dataclass

from markupsafe import Markup

from asp.language import Literal
from testbed.experiment.record import COARSE, Explained, TrialRecord
from testbed.protocol import Explanation

_TRIAL = Markup(
    "<table><caption>{caption}</caption><thead><tr><th>step</th><th>robot</th><th>others</th>"
    "<th>explained by</th></tr></thead><tbody>{rows}</tbody></table>"
)
_ROW = Markup(
    "<tr><td>{0.number}</td><td>{0.robot}</td><td>{0.others}</td><td>{0.explained}</td></tr>"
)


@dataclass(frozen=True)
class Step:
    """A line of a trial's timeline; `kind` is how it is coloured."""

    number: int
    kind: str
    robot: str
    others: str
    explained: str


def timeline(record: TrialRecord) -> Iterator[Step]:
    """The steps of a trial: what the robot did, what others did, what the robot explained.

    At the fine resolution those alone at which something begins or is heard of.
    """
    attempts = {attempt.step: attempt for attempt in record.actions}
    mental = {item.step: item.action for item in record.mental}
    others = {item.step: item for item in record.exogenous}
    explanations = {item.step: item for item in record.explanations}
    rejected = {item.step: f"{item.action}, not possible" for item in record.rejected}
    told = {*rejected, *attempts, *mental, *others, *explanations}
    for number in range(1, record.steps + 1):
        attempt, event = attempts.get(number), others.get(number)
        if record.fine is not None and number not in told:
            continue
        kind, robot = "mental", str(mental.get(number, "wait"))
        if attempt is not None:
            kind, failed = ("done", "") if attempt.happened else ("failed", " failed")
            robot = f"{attempt.action}{failed}"
        unseen = "" if event is None or event.observed else ", unseen"
        seen = rejected.get(number, "") if event is None else f"{event.action}{unseen}"
        adopted = explanations.get(number)
        yield Step(number, kind, robot, seen, explanation(adopted) if adopted else "")


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
