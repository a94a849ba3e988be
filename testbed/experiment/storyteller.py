"""Tell a trial while it is played: the moments of it, and the steps of its story."""

from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass

from asp.language import Action, Fluent, Literal
from testbed.experiment.record import At
from testbed.experiment.stories import FineStep, Story, StoryStep
from testbed.protocol import FINISH, Decision, FineTrace, Percept
from testbed.world import World, bits


@dataclass(frozen=True)
class Moment:
    """One step of a trial: what the robot was told, answered, and what became of it.

    `happened` is None unless the robot attempted a physical action; `event` is the exogenous
    action, or None; `skipped` are those of a script that were not possible; `before` and `after`
    are states of the world.
    """

    percept: Percept
    decision: Decision
    happened: bool | None
    event: Action | None
    before: int
    after: int
    skipped: tuple[Action, ...] = ()


Watch = Callable[[Moment], None]


class Storyteller:
    """Makes the story of a trial, moment by moment, in their order.

    `coarse` are the fluents of the coarse resolution where the world is of the fine one. Of the
    fine resolution the story has the inertial fluents.
    """

    def __init__(self, trial: str, world: World, coarse: Collection[Fluent] | None = None) -> None:
        self._trial, self._world, self._coarse = trial, world, coarse
        self._shown = -1  # all bits
        if coarse is not None:
            shown = frozenset(coarse).union(world.description.inertial)
            self._shown = sum(1 << n for n, own in enumerate(world.fluents) if own in shown)
        self._steps: list[StoryStep] = []
        self._state = self._after = 0
        self._true: set[Fluent] = set()  # of those that a robot has beliefs about

    @property
    def story(self) -> Story:
        """The story of the moments so far."""
        came, went = self._changes(self._state, self._after)
        return Story(trial=self._trial, steps=self._steps, end=_literals(came, went))

    def tell(self, moment: Moment) -> StoryStep:
        """The step that this moment is; it is the next one of the story."""
        percept, decision, trace = moment.percept, moment.decision, moment.decision.trace
        finishes = decision.action == FINISH
        step = StoryStep(
            step=percept.step,
            action=decision.action,
            mental=FINISH if finishes else trace.mental,
            happened=moment.happened,
            gives_up=finishes and not decision.believes_goal,
            event=moment.event,
            skipped=list(moment.skipped),
            told=[At(event.step, event.action) for event in percept.events],
            goal_holds=percept.goal_holds,
            world=self._arrive(moment.before),
            mistaken=self._mistaken(trace.belief) if trace.belief else None,
            unheeded=trace.unheeded or [],
            contradictions=trace.contradictions,
            explanation=trace.explanation,
            alternatives=trace.alternatives or [],
            more_alternatives=trace.more_alternatives,
            intention=trace.intention,
            plan=trace.plan,
            reason=trace.reason,
            no_plan=trace.no_plan,
            fine=None if self._coarse is None else self._fine(moment, trace.fine or FineTrace()),
        )
        self._after = moment.after
        self._steps.append(step)
        return step

    def _arrive(self, state: int) -> list[Literal]:
        """What holds in the state and did not in the one before; at first what is true."""
        came, went = self._changes(self._state, state)
        self._state = state
        coarse = self._coarse
        self._true.update(own for own in came if coarse is None or own in coarse)
        self._true.difference_update(went)
        return _literals(came, went)

    def _changes(self, before: int, after: int) -> tuple[list[Fluent], list[Fluent]]:
        """The shown fluents that came to be true, and those that ceased to, each sorted."""
        changed = (before ^ after) & self._shown
        fluents = self._world.fluents
        came = sorted(fluents[number] for number in bits(changed & after))
        return came, sorted(fluents[number] for number in bits(changed & before))

    def _mistaken(self, belief: Collection[Fluent]) -> list[Literal]:
        believed = frozenset(belief)
        return _literals(sorted(self._true - believed), sorted(believed - self._true))

    def _fine(self, moment: Moment, trace: FineTrace) -> FineStep:
        observed = moment.percept.visible
        return FineStep(
            abstract=trace.abstract,
            begun=trace.begun,
            zoomed=trace.zoomed,
            plan=trace.plan,
            observed=observed,
            wrong=[own for own in observed if not self._world.holds(moment.before, own)],
            committed=trace.committed,
            failed=trace.failed,
            ended=trace.ended,
            happened=trace.happened,
            inferred=trace.inferred,
        )


def _literals(true: Iterable[Fluent], false: Iterable[Fluent]) -> list[Literal]:
    return [*true, *(fluent.complement for fluent in false)]
