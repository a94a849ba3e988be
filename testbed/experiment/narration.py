"""Tell a trial in lines of text, step by step of its story."""

from collections.abc import Collection, Iterator

from asp.language import Action, Fluent
from asp.refinement import Refinement
from testbed.experiment.specs import Setting
from testbed.experiment.stories import FineStep, StoryStep, applied, believed
from testbed.experiment.trial_setup import refinement_of
from testbed.experiment.wording import Said, explained, noticed, reasons, refined, told
from testbed.text import Say
from testbed.world import world_of

SEPARATORS = {"told": ", "} | dict.fromkeys(
    ("unheeded", "certain now", "inferred", "relevant", "refined to"), " "
)
"""Between texts that stand in one line."""


class Narrator:
    """Tells the steps of one story in their order; what is as before is not told again."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._true: frozenset[Fluent] = frozenset()
        self._plan: tuple[Action, ...] = ()

    def tell(self, step: StoryStep) -> None:
        """Tell one step."""
        self._true = applied(self._true, step.world)
        for line in (*self._head(step), *self._lines(step)):
            self._say(line)

    def _head(self, step: StoryStep) -> Iterator[str]:
        yield from ("", f"step {step.step}")

    def _lines(self, step: StoryStep) -> Iterator[str]:
        yield from self._state(step)
        yield from _lines(told(step))
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
        yield from _lines(explained(step))
        yield f"  intention    {step.intention or '-'}{self._new_plan(step)}"
        yield from _lines(reasons(step))

    def _belief(self, step: StoryStep) -> str:
        if step.mistaken is None:
            return "not reported"
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
        yield from _lines(noticed(fine))
        begins = fine.begun == step.step
        if not fine.abstract or begins:
            yield from super()._mind(step)
        yield from _lines(own for own in refined(fine) if begins or own[0] != "abstract")


def _lines(said: Said) -> Iterator[str]:
    """A line per term, or per text where a text is long."""
    for term, texts in said:
        separator = SEPARATORS.get(term)
        shown = texts if separator is None else [separator.join(map(str, texts))]
        label = "  or" if term == "or" else term
        yield from (f"  {label:<12} {text}" for text in shown)


def narrator_of(setting: Setting, say: Say) -> Narrator:
    """Tells the trials of a setting."""
    return narrator_in(None if setting.fine is None else refinement_of(setting), say)


def narrator_in(refinement: Refinement | None, say: Say) -> Narrator:
    """Tells trials at the fine resolution of a refinement; without one at the coarse resolution."""
    if refinement is None:
        return Narrator(say)
    inertial = world_of(refinement).description.inertial
    return FineNarrator(say, inertial, refinement.description.fluents)
