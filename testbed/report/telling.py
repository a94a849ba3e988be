"""Trials as the explorer of a page is told of them: facts, and what there is to see by step."""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

from testbed.experiment.record import COARSE, At, Report, TrialRecord
from testbed.experiment.stories import FineStep, Story, StoryStep
from testbed.experiment.timeline import explanation
from testbed.protocol import FINISH, WAIT, Contradiction
from testbed.report.scenes import Atoms, Scenes, Theatre
from testbed.world import StateError, UnknownActionError, World

Told = dict[str, Any]
"""What becomes JSON; what is empty is left out of steps."""


def facts(record: TrialRecord) -> Told:
    """What is known of a trial besides its steps."""
    return {
        "id": record.trial,
        "pair": record.pair,
        "cell": record.cell,
        "scenario": record.scenario,
        "level": record.level,
        "robot": record.robot,
        "outcome": record.outcome,
        "achieved": record.achieved,
        "correct": record.correct,
        "seed": record.seed,
        "goal": record.goal,
        "initial": record.initial,
        "reason": record.reason,
        "actions": record.action_count,
        "units": record.execution_units,
        "reasoning_s": round(record.reasoning_time_s, 4),
        "steps": record.steps,
        "explained": [{"step": own.step, "text": explanation(own)} for own in record.explanations],
    }


def outline(record: TrialRecord) -> Iterator[Told]:
    """The steps of a trial as far as its record has them, and its end."""
    attempts = {own.step: own for own in record.actions}
    mental = {own.step: own.action for own in record.mental}
    events = {own.step: own for own in record.exogenous}
    for step in range(1, record.steps + 1):
        attempt, event = attempts.get(step), events.get(step)
        yield _filled(
            step=step,
            kind=_kind(attempt.happened if attempt else None),
            action=attempt.action if attempt else FINISH if mental.get(step) == FINISH else WAIT,
            mental=mental.get(step),
            happened=attempt and attempt.happened,
            event=event and event.action,
            seen=event and event.observed,
            told=[_at(own) for own in record.reports if own.told == step],
        )
    yield {"step": record.steps + 1, "kind": "end"}


def without_story(record: TrialRecord, theatre: Theatre, scenes: Scenes) -> list[Told]:
    """The steps of a trial of which the record alone is known, each with what was true then.

    Of the fine resolution that is known at the first step alone, and after an action with several
    outcomes not any more.
    """
    told = list(outline(record))
    world = theatre.world()
    with suppress(StateError, UnknownActionError):  # where the domain is another one by now
        for step, state in zip(told, _states(record, told, world), strict=False):
            step["scene"] = scenes.world(theatre, frozenset(world.true_atoms(state)))
    return told


def _states(record: TrialRecord, told: Sequence[Told], world: World) -> Iterator[int]:
    """The state at each step, as far as they follow from each other."""
    reached: Sequence[int] = (world.state(record.initial),)
    for step in told:
        if len(reached) != 1:
            return
        yield reached[0]
        if record.level != COARSE:  # the record has the abstract actions
            return
        done = [step["action"]] if step.get("happened") else []
        done += [step["event"]] if "event" in step else []
        reached = world.successors(reached[0], done)


def with_story(record: TrialRecord, story: Story, theatre: Theatre, scenes: Scenes) -> list[Told]:
    """The steps of a trial and its end, with what was true, and what the robot believed."""
    states = list(story.states())
    observed = {own.step for own in record.exogenous if own.observed}
    told = [
        _step(step, true, step.step in observed, theatre, scenes)
        for step, true in zip(story.steps, states[:-1], strict=True)
    ]
    end = scenes.world(theatre, states[-1])
    return [*told, {"step": story.steps[-1].step + 1, "kind": "end", "scene": end}]


def _step(step: StoryStep, true: Atoms, seen: bool, theatre: Theatre, scenes: Scenes) -> Told:
    mistaken = step.mistaken
    told = _filled(
        step=step.step,
        kind=_kind(step.happened),
        action=step.action,
        mental=step.mental,
        happened=step.happened,
        event=step.event,
        seen=seen if step.event else None,
        told=[*map(_at, step.told)],
        goal_holds=step.goal_holds,
        scene=scenes.world(theatre, true),
        belief=scenes.belief(theatre, true, mistaken) if mistaken else None,
        unheeded=step.unheeded,
        contradictions=[*map(_contrary, step.contradictions)],
        explanation=step.explanation and explanation(step.explanation),
        alternatives=[*map(explanation, step.alternatives)],
        more_alternatives=step.more_alternatives or None,
        intention=step.intention,
        plan=step.plan,
        reason=step.reason,
        also=dict(_also(step)),
    )
    return told | {"mistaken": mistaken}


def _also(step: StoryStep) -> Iterator[tuple[str, Sequence[str]]]:
    """What only some trials have, term by term."""
    if step.no_plan is not None:
        yield "no plan", [f"{step.no_plan}, as far as the robot believes"]
    if step.skipped:
        yield "not possible", step.skipped
    yield from _carried_out(step.fine or FineStep())


def _carried_out(fine: FineStep) -> Iterator[tuple[str, Sequence[str]]]:
    """How an abstract action is carried out."""
    if fine.observed:
        wrong = {*fine.wrong}
        yield "observed", [own + ", which is wrong" * (own in wrong) for own in fine.observed]
    if fine.committed:
        yield "certain now", fine.committed
    if fine.failed:
        yield "failed", [fine.failed]
    if fine.ended:
        yield "over", [f"{fine.ended}: {'happened' if fine.happened else 'did not happen'}"]
        yield "inferred", fine.inferred or ["nothing"]
    if fine.abstract:
        yield "abstract action", [fine.abstract]
    if fine.zoomed:
        yield "relevant", [" ".join(fine.zoomed)]
    if fine.plan:
        yield "refined to", fine.plan


def _kind(happened: bool | None) -> str:
    return "mental" if happened is None else "done" if happened else "failed"


def _at(own: At | Report) -> str:
    return f"{own.action} at step {own.step}"


def _contrary(own: Contradiction) -> str:
    return f"{own.observed} at step {own.step}, against {own.believed}"


def _filled(**values: object) -> Told:
    return {key: own for key, own in values.items() if own not in (None, "", [], {})}
