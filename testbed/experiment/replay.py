"""Play a stored trial again, in this process, and tell it step by step."""

import shlex
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path

from asp.language import Action, Fluent, suggestion
from testbed.experiment.digest import logical
from testbed.experiment.errors import StoreError
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import read_config
from testbed.experiment.specs import Setting, TrialSpec
from testbed.experiment.store import read_records
from testbed.experiment.storyteller import Moment
from testbed.experiment.timeline import explanation, in_words, of_place, place
from testbed.experiment.trial import play_trial, refinement_of
from testbed.link import InProcessRobot
from testbed.protocol import FINISH, FineTrace, Trace
from testbed.text import Say, columns, counted
from testbed.text.grid import Grid
from testbed.world import World, load_world, world_of

NEWER = ("condition", "unproved_steps", "unheeded_steps")
"""Keys that records of older versions do not have."""


def replay(folder: Path, trial: str, say: Say) -> bool:
    """Tell the trial of a run whose id begins with `trial`; is it as recorded?

    True also where there is no record of it yet.

    Raises as `stored_trial` does.
    """
    return replay_trial(*stored_trial(folder, trial), say)


def replay_trial(spec: TrialSpec, recorded: TrialRecord | None, say: Say) -> bool:
    """The same of a trial and its record."""
    where = of_place(spec.scenario, spec.level)
    say(f"trial {spec.trial}: {where}, {spec.robot}, seed {spec.seed}")
    say(f"goal: {' '.join(spec.setting.goal)}")
    narrator = narrator_of(spec.setting, say)
    now = play_trial(spec, InProcessRobot(make_robot), narrator.tell).record
    reason = f": {now.reason}" if now.reason else ""
    steps, actions = counted(now.steps, "step"), counted(now.action_count, "action")
    units = counted(now.execution_units, "execution unit")
    say("")
    say(f"outcome {now.outcome}{reason} after {steps}, {actions}, {units}")
    return _compare(recorded, now, say)


def stored_trial(folder: Path, trial: str) -> tuple[TrialSpec, TrialRecord | None]:
    """The trial of a run whose id begins with `trial`, and its record if there is one yet.

    Raises:
        StoreError: for a folder without a run, or an id that is not one of its trials.
        ConfigError: where the stored configuration is not valid any more.
    """
    config = read_config(folder)
    played = [record for record in read_records(folder) if record.trial.startswith(trial)]
    # No trial depends on other levels, and where there are hundreds a level drawing all takes long.
    on_record = {record.level for record in played}
    levels = tuple(level for level in config.levels if level in on_record)
    if levels and trial:
        config = config.model_copy(update={"levels": levels})
    spec = find_trial(plan_trials(config), trial)
    return spec, next((own for own in played if own.trial == spec.trial), None)


def list_trials(folder: Path, say: Say) -> None:
    """Say which trials a run has, with their outcomes so far. Raises as `stored_trial`."""
    specs = plan_trials(read_config(folder))
    outcomes = {record.trial: record.outcome for record in read_records(folder)}
    fine = any(spec.setting.fine is not None for spec in specs)
    heads = ("trial", "level" if fine else "scenario", "robot", "outcome")
    listed = ((s.trial, place(s.scenario, s.level), s.robot) for s in specs)
    rows = [(*own, in_words(outcomes.get(own[0], "not played yet"))) for own in listed]
    for line in Grid(heads, rows, numbers=range(0)).lines(columns()):
        say(line)
    command = f"testbed replay {shlex.quote(str(folder))} --trial"
    say(f"choose one by its id, or the beginning of it: {command} {rows[-1][0]}")


def find_trial(specs: Sequence[TrialSpec], trial: str) -> TrialSpec:
    """The trial whose id begins with `trial`. Raises StoreError unless there is exactly one."""
    found = [spec for spec in specs if trial and spec.trial.startswith(trial)]
    if len(found) == 1:
        return found[0]
    if found:
        ids = ", ".join(spec.trial for spec in found[:5])
        raise StoreError(f"--trial {trial}: several trials begin so: {ids}")
    one = f"one of them is {specs[0].trial}"
    hint = suggestion(trial, [spec.trial for spec in specs], otherwise=one)
    among = f"not one of the run's {counted(len(specs), 'trial')}"
    raise StoreError(f"--trial {trial}: {among}; {hint}")


def _compare(recorded: TrialRecord | None, now: TrialRecord, say: Say) -> bool:
    if recorded is None:
        say("the run has no record of this trial yet")
        return True
    before, after = logical(recorded), logical(now)
    uncounted = {key for key in NEWER if before[key] is None}
    changed = [key for key in before if before[key] != after[key] and key not in uncounted]
    if not changed:
        say("as recorded")
    if recorded.outcome == "robot_lost":
        say(
            f"recorded as robot lost: {recorded.reason}; a robot that was lost there need not be "
            "lost again, for here it runs in this process and without a limit to its time"
        )
        return True
    for key in changed:
        say(f"differs from the record: {key} was {before[key]}, is {after[key]}")
    return not changed


class Narrator:
    """Tells a trial while it is played; what is as at the step before is not told again."""

    def __init__(self, world: World, say: Say) -> None:
        self._world, self._say = world, say
        self._plan: tuple[Action, ...] = ()
        self._believed = False

    def tell(self, moment: Moment) -> None:
        """Tell one step."""
        for line in ("", f"step {moment.percept.step}", *self._lines(moment)):
            self._say(line)

    def _lines(self, moment: Moment) -> Iterator[str]:
        percept, action = moment.percept, moment.decision.action
        true = frozenset(self._world.true_atoms(moment.before))
        yield from self._state(true)
        if percept.goal_holds is False:
            yield "  told         the goal does not hold"
        if percept.events:
            news = (f"{event.action} at step {event.step}" for event in percept.events)
            yield f"  told         {', '.join(news)}"
        yield from self._mind(moment, true)
        gives_up = action == FINISH and not moment.decision.believes_goal
        ended = ": did not happen" if moment.happened is False else ": gives up" * gives_up
        yield f"  action       {action}{ended}"
        if moment.event is not None:
            yield f"  others       {moment.event}"
        yield from (f"  others       {own}: was not possible" for own in moment.skipped)

    def _state(self, true: frozenset[Fluent]) -> Iterator[str]:
        yield f"  world        {' '.join(sorted(true))}"

    def _mind(self, moment: Moment, true: frozenset[Fluent]) -> Iterator[str]:
        trace = moment.decision.trace
        yield f"  belief       {self._belief(trace)}"
        if trace.belief and sorted(trace.belief) != sorted(true):
            yield f"               in truth {_difference(trace.belief, true)}"
        if trace.unheeded:
            yield f"  unheeded     {' '.join(trace.unheeded)}"
        for contrary in trace.contradictions:
            against = f"{contrary.observed} at step {contrary.step} against {contrary.believed}"
            yield f"  unexpected   {against}"
        if trace.explanation is not None:
            unproved = "; minimal: unproved" * (trace.explanation.minimal == "unproved")
            yield f"  explanation  {explanation(trace.explanation)}{unproved}"
        yield from (f"    or         {explanation(other)}" for other in trace.alternatives or ())
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

    def _state(self, true: frozenset[Fluent]) -> Iterator[str]:
        """All at first, and then what is new."""
        before, self._told_of = self._told_of, true & self._inertial
        if before is None:
            yield from super()._state(self._told_of)
        elif before != self._told_of:
            yield f"  world        now {_difference(before, self._told_of)}"

    def _mind(self, moment: Moment, true: frozenset[Fluent]) -> Iterator[str]:
        fine, step = moment.decision.trace.fine or FineTrace(), moment.percept.step
        for literal in moment.percept.visible:
            wrong = "" if self._world.satisfies(moment.before, (literal,)) else ", which is wrong"
            yield f"  observed     {literal}{wrong}"
        if fine.committed:
            yield f"  certain now  {' '.join(fine.committed)}"
        if fine.failed:
            yield f"  failed       {fine.failed}"
        if fine.ended:
            outcome = "happened" if fine.happened else "did not happen"
            yield f"  over         {fine.ended}: {outcome}"
            yield f"  inferred     {' '.join(fine.inferred) or 'nothing'}"
        if not fine.abstract or fine.begun == step:
            yield from super()._mind(moment, true & self._coarse)
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
    refinement = refinement_of(setting)
    return FineNarrator(world_of(refinement), refinement.description.fluents, say)
