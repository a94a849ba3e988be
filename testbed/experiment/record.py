"""The record of a trial: one line of `trials.jsonl`, every key of it stated here.

Steps are the environment's: 0 is the selection of the goal, the robot's first answer is step 1.
"""

from typing import Annotated, NamedTuple, TypeAlias, get_args
from typing import Literal as Choice

import msgspec

from asp.language import Action, Literal
from testbed.experiment.origin import Origin
from testbed.experiment.specs import Setting
from testbed.protocol import Contradiction, Count, Minimality, NoPlan

Outcome = Choice["achieved", "false_finish", "gave_up", "step_limit", "robot_lost", "error"]
OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)
FAILURES: tuple[Outcome, ...] = ("robot_lost", "error")
MinimalReason = Choice["no plan", "budget"]
"""Why the least that achieves a goal is not known."""
Cause = Choice["robot", "infrastructure", "testbed"]
"""What a trial failed for: the robot's own error; a process that ended, or the link to it; ours."""
COARSE = "coarse"
"""The level of trials at the coarse resolution."""
TIMES = ("_time_s", "_cpu_s")
"""How keys of a record end that hold times."""
Total: TypeAlias = Annotated[float, msgspec.Meta(ge=0.0, le=1e15)]
"""A finite sum of seconds."""


class Minimal(NamedTuple):
    """The least number of actions, and of units, that achieves a goal; where unknown, why."""

    actions: int | None
    units: int | None
    reason: MinimalReason | None


class At(msgspec.Struct):
    """An action at a step."""

    step: Count
    action: Action


class Attempt(At):
    """A physical action of the robot, and whether it took effect."""

    happened: bool


class Occurrence(At):
    """An exogenous action that happened, and whether the robot was told of it, if only later."""

    observed: bool


class Rejected(At):
    """An exogenous action that a script has for this step, that was not possible, and why."""

    reason: str


class Report(msgspec.Struct):
    """News that reached the robot at step `told`: that `action` happened at `step`; is it true?"""

    told: Count
    step: Count
    action: Action
    true: bool


class Explained(msgspec.Struct):
    """An explanation that the robot adopted at `step`, and why it needed one.

    `distrusted` are reports that it takes for false, own attempts that were not executed, and
    fluents that a test was wrong about; `outcomes` are actions whose outcome was another one than
    it expected; `alternatives` is the number of other explanations that are
    as small, None where the robot does not look for them (0 in older records); there are more of
    them if `more_alternatives`. `minimal` is
    `unproved` where the budget of the decision did not suffice to rule out a smaller one.
    """

    step: Count
    unobserved: list[At]
    exceptions: list[Literal]
    distrusted: list[At] = []
    outcomes: list[At] = []
    contradictions: list[Contradiction] = []
    alternatives: Count | None = None
    more_alternatives: bool = False
    minimal: Minimality = "proved"


class Activity(msgspec.Struct):
    """An activity of the robot: when it started, its plan, and when it was stopped (or None).

    With the stop come the first step at which the rest of the plan would have failed, and why.
    """

    name: Count
    start: Count
    plan: list[Action]
    stop: Count | None = None
    futile_at: Count | None = None
    reason: str | None = None


class FineCounts(msgspec.Struct):
    """What was done at the fine resolution: how many refined plans, concrete actions and tests.

    `planning_time_s` is that of zooming and planning, `infer_time_s` that of what follows from
    observations, both by the wall clock; `planning_cpu_s` and `infer_cpu_s` in process time.
    """

    plans: Count = 0
    actions: Count = 0
    tests: Count = 0
    planning_time_s: Total = 0.0
    infer_time_s: Total = 0.0
    planning_cpu_s: Total = 0.0
    infer_cpu_s: Total = 0.0


class TrialRecord(msgspec.Struct, kw_only=True):
    """The record of a trial.

    `cell` is the name of the sweep's condition that it was played under, `condition` all that was
    the same for every trial of its scenario, or level, under it; None in older records. `origin`
    says where the record came from; None there, too.
    At the fine resolution `initial` and `exogenous` are of that resolution, `actions` are the
    abstract ones, each at the step at which it began. `in_reach` says of a trial that does not
    achieve its goal whether that could still be achieved from where the trial ended.
    `reason` is one line that says why a trial was lost, given up, or ended in error, or that it was
    over before its script; `cause` is None unless it was lost or ended in error.
    `retried` are the reasons of earlier attempts at the trial, which failed.
    `minimal_actions` and `minimal_units` are the judge's, from the initial state with nothing
    exogenous, of a trial that counts. Where the actions are None `minimal_reason`
    says why: `no plan` exists, or the `budget` of states did not suffice to find the least. The
    plan with the fewest actions need not be the one that costs least. `oracle_units` are the fewest
    units for who knows the events of the trial beforehand; None where they are not known.
    `correct` is None where that depends on the fewest actions and these are not known (so is
    `in_reach`), and of a trial that something other than its robot ended: it says nothing of the
    robot.
    `no_plan` says why the robot gave up, from what it believed; `in_reach` from what is true.
    `unproved_steps` is the number of decisions under an explanation that is not proved to be as
    small as any, `unheeded_steps` that of decisions at which it saw the contrary of what it
    believed and did not heed it; None where the robot does not tell.
    `mental` holds `start(N)`, `stop(N)` and `finish`.
    Times are seconds, `..._time_s` by the wall clock, `..._cpu_s` process time of the robot, its
    solver included. `preparation_cpu_s` is what the trial's decisions caused but others can reuse
    (encoding, grounding, sets of states); no other time of reasoning has it.
    """

    trial: str
    pair: str
    scenario: str
    seed: int
    robot: str
    domain: str
    level: str
    initial: list[Literal]
    goal: list[Literal]
    cell: str = ""
    condition: Setting | None = None
    origin: Origin | None = None
    achieved: bool = False
    finished: bool = False
    correct: bool | None = False
    minimal_actions: Count | None = None
    minimal_units: Count | None = None
    minimal_reason: MinimalReason | None = None
    oracle_units: Count | None = None
    outcome: Outcome = "error"
    reason: str | None = None
    cause: Cause | None = None
    retried: list[str] = []
    steps: Count = 0
    actions: list[Attempt] = []
    exogenous: list[Occurrence] = []
    rejected: list[Rejected] = []
    reports: list[Report] = []
    explanations: list[Explained] = []
    mental: list[At] = []
    activities: list[Activity] = []
    plans: Count = 0
    action_count: Count = 0
    execution_units: Count = 0
    planning_time_s: Total = 0.0
    diagnosis_time_s: Total = 0.0
    reasoning_time_s: Total = 0.0
    wall_time_s: Total = 0.0
    planning_cpu_s: Total = 0.0
    diagnosis_cpu_s: Total = 0.0
    preparation_cpu_s: Total = 0.0
    fine: FineCounts | None = None
    in_reach: bool | None = None
    no_plan: NoPlan | None = None
    unproved_steps: Count | None = None
    unheeded_steps: Count | None = None
    deadline: bool = False

    @property
    def failed(self) -> bool:
        """Whether the robot's own error ended the trial: it counts, and is not correct."""
        return self.outcome in FAILURES and self.cause == "robot"

    def _repr_html_(self) -> str:
        """What a notebook shows: how the trial came out, and what happened step by step."""
        from testbed.experiment.timeline import html_of  # noqa: PLC0415  # which is about records

        return html_of(self)
