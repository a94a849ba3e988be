"""Tell a trial in lines of text, step by step of its story."""

from collections.abc import Collection, Iterator

from asp.language import Action, Fluent
from asp.refinement import Refinement
from testbed.experiment.specs import Setting
from testbed.experiment.stories import FineStep, StoryStep, applied, believed
from testbed.experiment.timeline import explanation
from testbed.experiment.trial import refinement_of
from testbed.text import Say
from testbed.world import world_of


class Narrator:
    """Tells the steps of one story in their order; what is as before is not told again."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._true: frozenset[Fluent] = frozenset()
        self._plan: tuple[Action, ...] = ()
        self._believed = False

    def tell(self, step: StoryStep) -> None:
        """Tell one step."""
        self._true = applied(self._true, step.world)
        for line in ("", f"step {step.step}", *self._lines(step)):
            self._say(line)

    def _lines(self, step: StoryStep) -> Iterator[str]:
        yield from self._state(step)
        if step.goal_holds is False:
            yield "  told         the goal does not hold"
        if step.told:
            news = (f"{event.action} at step {event.step}" for event in step.told)
            yield f"  told         {', '.join(news)}"
        yield from self._mind(step)
        ended = ": did not happen" if step.happened is False else ": gives up" * step.gives_up
        yield f"  action       {step.action}{ended}"
        if step.event is not None:
            yield f"  others       {step.event}"
        yield from (f"  others       {own}: was not possible" for own in step.skipped)

    def _state(self, _step: StoryStep) -> Iterator[str]:
        yield f"  world        {' '.join(sorted(self._true))}"

    def _mind(self, step: StoryStep) -> Iterator[str]:
        yield f"  belief       {self._belief(step)}"
        if step.mistaken:
            yield f"               in truth {' '.join(step.mistaken)}"
        if step.unheeded:
            yield f"  unheeded     {' '.join(step.unheeded)}"
        for contrary in step.contradictions:
            against = f"{contrary.observed} at step {contrary.step} against {contrary.believed}"
            yield f"  unexpected   {against}"
        if step.explanation is not None:
            unproved = "; minimal: unproved" * (step.explanation.minimal == "unproved")
            yield f"  explanation  {explanation(step.explanation)}{unproved}"
        yield from (f"    or         {explanation(other)}" for other in step.alternatives)
        if step.more_alternatives:
            yield "    or         others, not all of which are listed"
        yield f"  intention    {step.intention or '-'}{self._new_plan(step)}"
        if step.reason:
            yield f"  because      {step.reason}"
        if step.no_plan is not None:
            yield f"  no plan      {step.no_plan}, as far as the robot believes"

    def _belief(self, step: StoryStep) -> str:
        if step.mistaken is None:
            return "as before" if self._believed else "not reported"
        self._believed = True
        return " ".join(sorted(believed(self._of_beliefs(), step.mistaken)))

    def _of_beliefs(self) -> frozenset[Fluent]:
        """What is true of what a robot has beliefs about."""
        return self._true

    def _new_plan(self, step: StoryStep) -> str:
        """The plan, unless it is what is left of the one told last."""
        plan, told = tuple(step.plan), self._plan
        self._plan = plan or told
        return f"; plan: {' '.join(plan)}" if plan != told[len(told) - len(plan) :] else ""


class FineNarrator(Narrator):
    """Tells a trial at both resolutions: the abstract action and why, its refined plan, each
    concrete action, what was observed, what failed, and what was inferred in the end.
    """

    def __init__(self, say: Say, inertial: Collection[str], coarse: Collection[str]) -> None:
        """`inertial` are the fluents that tell the world, `coarse` those of the coarse one."""
        super().__init__(say)
        self._inertial, self._coarse = frozenset(inertial), frozenset(coarse)
        self._first = True

    def _of_beliefs(self) -> frozenset[Fluent]:
        return self._true & self._coarse

    def _state(self, step: StoryStep) -> Iterator[str]:
        """All at first, and then what is new."""
        first, self._first = self._first, False
        told = [literal for literal in step.world if literal.atom in self._inertial]
        if first or told:
            yield f"  world        {'' if first else 'now '}{' '.join(told)}"

    def _mind(self, step: StoryStep) -> Iterator[str]:
        fine = step.fine or FineStep()
        for literal in fine.observed:
            wrong = ", which is wrong" if literal in fine.wrong else ""
            yield f"  observed     {literal}{wrong}"
        if fine.committed:
            yield f"  certain now  {' '.join(fine.committed)}"
        if fine.failed:
            yield f"  failed       {fine.failed}"
        if fine.ended:
            outcome = "happened" if fine.happened else "did not happen"
            yield f"  over         {fine.ended}: {outcome}"
            yield f"  inferred     {' '.join(fine.inferred) or 'nothing'}"
        if not fine.abstract or fine.begun == step.step:
            yield from super()._mind(step)
        if fine.begun == step.step:
            yield f"  abstract     {fine.abstract}"
        if fine.zoomed:
            yield f"  relevant     {' '.join(fine.zoomed)}"
        if fine.plan:
            yield f"  refined to   {' '.join(fine.plan)}"


def narrator_of(setting: Setting, say: Say) -> Narrator:
    """Tells the trials of a setting."""
    return narrator_in(None if setting.fine is None else refinement_of(setting), say)


def narrator_in(refinement: Refinement | None, say: Say) -> Narrator:
    """Tells trials at the fine resolution of a refinement; without one at the coarse resolution."""
    if refinement is None:
        return Narrator(say)
    inertial = world_of(refinement).description.inertial
    return FineNarrator(say, inertial, refinement.description.fluents)
