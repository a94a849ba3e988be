"""Trials as the explorer of a page is told of them: facts, and what there is to see by step."""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

from testbed.experiment.record import COARSE, TrialRecord
from testbed.experiment.stories import Story, StoryStep
from testbed.experiment.timeline import Step, kind_of, steps_of
from testbed.experiment.wording import Said, adopted, at_step, mind
from testbed.protocol import FINISH, WAIT
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
    }


def outline(record: TrialRecord) -> Iterator[Told]:
    """The steps of a trial as far as its record has them, and its end."""
    for own in steps_of(record):
        attempt, event = own.attempt, own.event
        yield _filled(
            step=own.number,
            kind=own.kind,
            action=attempt.action if attempt else FINISH if own.mental == FINISH else WAIT,
            mental=own.mental,
            happened=attempt and attempt.happened,
            event=event and event.action,
            seen=event and event.observed,
            skipped=[one.action for one in own.rejected],
            mind=_terms(_known(record, own)),
        )
    yield {"step": record.steps + 1, "kind": "end"}


def _known(record: TrialRecord, step: Step) -> Said:
    """What a record has of the mind at a step."""
    if news := [own for own in record.reports if own.told == step.number]:
        yield "told", [*map(at_step, news)]
    if step.explained is not None:
        yield "explanation", [adopted(step.explained)]


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
        kind=kind_of(step.happened),
        action=step.action,
        mental=step.mental,
        happened=step.happened,
        event=step.event,
        seen=seen if step.event else None,
        skipped=step.skipped,
        mind=_terms(mind(step)),
        scene=scenes.world(theatre, true),
        belief=scenes.belief(theatre, true, mistaken) if mistaken else None,
    )
    return told | {"mistaken": mistaken}


def _terms(said: Said) -> dict[str, list[object]]:
    """The texts of each term."""
    terms: dict[str, list[object]] = {}
    for term, texts in said:
        terms.setdefault(term, []).extend(texts)
    return terms


def _filled(**values: object) -> Told:
    return {key: own for key, own in values.items() if own not in (None, "", [], {})}
