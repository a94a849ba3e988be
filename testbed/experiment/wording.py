"""What a step tells of a robot's mind, as terms and texts: one wording for whoever shows it."""

from collections.abc import Iterator, Sequence

from testbed.experiment.record import At, Explained, Report
from testbed.experiment.stories import FineStep, StoryStep
from testbed.experiment.timeline import explanation
from testbed.protocol import Explanation

Said = Iterator[tuple[str, Sequence[object]]]
"""Terms, and the texts of each, of which there is one at least."""


def mind(step: StoryStep) -> Said:
    """All that a step tells of a mind; a term may come twice."""
    yield from told(step)
    yield from noticed(step.fine or FineStep())
    yield from explained(step)
    yield from intended(step)
    yield from reasons(step)
    yield from refined(step.fine or FineStep())


def told(step: StoryStep) -> Said:
    """What the robot was told before it answered."""
    if step.goal_holds is False:
        yield "told", ["the goal does not hold"]
    if step.told:
        yield "told", [*map(at_step, step.told)]


def explained(step: StoryStep) -> Said:
    """What did not fit, and how it is explained."""
    if step.unheeded:
        yield "unheeded", step.unheeded
    for own in step.contradictions:
        yield "unexpected", [f"{own.observed} at step {own.step} against {own.believed}"]
    if step.explanation is not None:
        yield "explanation", [adopted(step.explanation)]
    if step.alternatives:
        yield "or", [*map(explanation, step.alternatives)]
    if step.more_alternatives:
        yield "or", ["others, not all of which are listed"]


def intended(step: StoryStep) -> Said:
    """What is intended."""
    if step.intention is not None:
        yield "intention", [step.intention]
    if step.plan:
        yield "plan", step.plan


def reasons(step: StoryStep) -> Said:
    """Why, as far as there are words for it."""
    if step.reason:
        yield "because", [step.reason]
    if step.no_plan is not None:
        yield "no plan", [f"{step.no_plan}, as far as the robot believes"]


def noticed(fine: FineStep) -> Said:
    """What was observed at the fine resolution, and what follows from it."""
    if fine.observed:
        wrong = {*fine.wrong}
        yield "observed", [f"{own}{', which is wrong' * (own in wrong)}" for own in fine.observed]
    if fine.committed:
        yield "certain now", fine.committed
    if fine.failed:
        yield "failed", [fine.failed]
    if fine.ended:
        yield "over", [f"{fine.ended}: {'happened' if fine.happened else 'did not happen'}"]
        yield "inferred", fine.inferred or ["nothing"]


def refined(fine: FineStep) -> Said:
    """How an abstract action is carried out."""
    if fine.abstract:
        yield "abstract", [fine.abstract]
    if fine.zoomed:
        yield "relevant", fine.zoomed
    if fine.plan:
        yield "refined to", fine.plan


def adopted(own: Explanation | Explained) -> str:
    """An explanation, and whether a smaller one is not ruled out."""
    return explanation(own) + "; minimal: unproved" * (own.minimal == "unproved")


def at_step(own: At | Report) -> str:
    """An action and its step."""
    return f"{own.action} at step {own.step}"
