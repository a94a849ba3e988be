"""Tell a trial step by step while it is played."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence

from testbed.environment import FINISH
from testbed.experiment.specs import Setting
from testbed.experiment.timeline import explanation
from testbed.experiment.trial import Moment
from testbed.experiment.trial_setup import load_ground
from testbed.protocol import FineTrace, Trace
from testbed.world import World, load_world, world_of

Say = Callable[[str], None]


class Narrator:
    """Tells a trial while it is played; what is as at the step before is not told again."""

    def __init__(self, world: World, say: Say) -> None:
        self._world = world
        self._say = say
        self._plan: tuple[str, ...] = ()
        self._believed = False

    def tell(self, moment: Moment) -> None:
        """Tell one step."""
        for line in self._lines(moment):
            self._say(line)

    def _lines(self, moment: Moment) -> Iterator[str]:
        trace = moment.decision.trace
        yield ""
        yield f"step {moment.percept.step}"
        truth = sorted(self._world.true_atoms(moment.before))
        yield f"  world        {' '.join(truth)}"
        yield from _told(moment)
        yield from self._mind(trace, truth)
        yield f"  action       {_action(moment)}"
        yield from _others(moment)

    def _mind(self, trace: Trace, truth: Sequence[str]) -> Iterator[str]:
        yield f"  belief       {self._belief(trace)}"
        if trace.belief and sorted(trace.belief) != truth:
            yield f"               in truth {_difference(trace.belief, truth)}"
        for contrary in trace.contradictions:
            against = f"{contrary.observed} at step {contrary.step} against {contrary.believed}"
            yield f"  unexpected   {against}"
        if trace.explanation is not None:
            unproved = "; minimal: unproved" * (trace.explanation.minimal == "unproved")
            yield f"  explanation  {explanation(trace.explanation)}{unproved}"
        yield from (f"    or         {explanation(other)}" for other in trace.alternatives)
        if trace.more_alternatives:
            yield "    or         others, not all of which are listed"
        yield f"  intention    {trace.intention or '-'}{self._new_plan(trace)}"
        if trace.reason:
            yield f"  because      {trace.reason}"
        if trace.no_plan is not None:
            yield f"  no plan      {trace.no_plan}, as far as the robot believes"

    def _belief(self, trace: Trace) -> str:
        if trace.belief:
            self._believed = True
            return " ".join(sorted(trace.belief))
        return "as before" if self._believed else "not reported"

    def _new_plan(self, trace: Trace) -> str:
        """The plan, unless it is what is left of the one told last."""
        plan, told = tuple(trace.plan), self._plan
        self._plan = plan or told
        return f"; plan: {' '.join(plan)}" if plan != told[len(told) - len(plan) :] else ""


def _difference(belief: Iterable[str], truth: Iterable[str]) -> str:
    missing, wrong = sorted(set(truth) - set(belief)), sorted(set(belief) - set(truth))
    return " ".join([*missing, *(f"-{atom}" for atom in wrong)])


def _action(moment: Moment) -> str:
    action = moment.decision.action
    if moment.happened is False:
        return f"{action}: did not happen"
    if action == FINISH and not moment.decision.believes_goal:
        return f"{action}: gives up"
    return action


def _others(moment: Moment) -> Iterator[str]:
    if moment.event is not None:
        yield f"  others       {moment.event}"
    for impossible in moment.skipped:
        yield f"  others       {impossible}: was not possible"


def _told(moment: Moment) -> Iterator[str]:
    if moment.percept.goal_holds is False:
        yield "  told         the goal does not hold"
    if moment.percept.events:
        news = (f"{event.action} at step {event.step}" for event in moment.percept.events)
        yield f"  told         {', '.join(news)}"


class FineNarrator(Narrator):
    """Tells a trial at both resolutions: the abstract action and why, its refined plan, each
    concrete action, what was observed, what failed, and what was inferred in the end.
    """

    def __init__(self, world: World, coarse: Collection[str], say: Say) -> None:
        """`coarse` are the fluents of the coarse resolution."""
        super().__init__(world, say)
        self._coarse = frozenset(coarse)
        self._inertial = frozenset(world.description.inertial)
        self._told_of: frozenset[str] | None = None

    def _lines(self, moment: Moment) -> Iterator[str]:
        fine = moment.decision.trace.fine or FineTrace()
        true = frozenset(self._world.true_atoms(moment.before))
        yield ""
        yield f"step {moment.percept.step}"
        yield from self._world_lines(true & self._inertial)
        yield from _told(moment)
        yield from self._observed(moment)
        yield from _learned(fine)
        if not fine.abstract or fine.begun == moment.percept.step:
            yield from self._mind(moment.decision.trace, sorted(true & self._coarse))
        yield from _refined(fine, moment.percept.step)
        yield f"  action       {_action(moment)}"
        yield from _others(moment)

    def _world_lines(self, true: frozenset[str]) -> Iterator[str]:
        """All at first, and then what is new."""
        before, self._told_of = self._told_of, true
        if before is None:
            yield f"  world        {' '.join(sorted(true))}"
        elif before != true:
            yield f"  world        now {_difference(before, true)}"

    def _observed(self, moment: Moment) -> Iterator[str]:
        for literal in moment.percept.visible:
            wrong = "" if self._world.satisfies(moment.before, (literal,)) else ", which is wrong"
            yield f"  observed     {literal}{wrong}"


def _learned(fine: FineTrace) -> Iterator[str]:
    """What came of the concrete actions so far."""
    if fine.committed:
        yield f"  certain now  {' '.join(fine.committed)}"
    if fine.failed:
        yield f"  failed       {fine.failed}"
    if fine.ended:
        outcome = "happened" if fine.happened else "did not happen"
        yield f"  over         {fine.ended}: {outcome}"
        yield f"  inferred     {' '.join(fine.inferred) or 'nothing'}"


def _refined(fine: FineTrace, step: int) -> Iterator[str]:
    """The abstract action, where it begins, and its refined plan where there is a new one."""
    if fine.begun == step:
        yield f"  abstract     {fine.abstract}"
    if fine.zoomed:
        yield f"  relevant     {' '.join(fine.zoomed)}"
    if fine.plan:
        yield f"  refined to   {' '.join(fine.plan)}"


def narrator_of(setting: Setting, say: Say) -> Narrator:
    """Tells the trials of a setting."""
    if setting.fine is None:
        return Narrator(load_world(setting.domain), say)
    refinement = load_ground(setting).refinement
    return FineNarrator(world_of(refinement), refinement.description.fluents, say)
