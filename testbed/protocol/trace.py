"""The mind behind a decision: what a robot believes, explains and intends."""

from typing import Literal as Choice
from typing import TypeAlias

from asp.language import Action, Literal
from testbed.protocol.bounds import Count, Items, Seconds, Text, literal_within_bounds
from testbed.protocol.parts import Event, Part, is_mental

NoPlan: TypeAlias = Choice["out of reach", "beyond the limit", "not known"]
"""Why a robot has no plan: no plan of any length exists, only a longer one, or neither is proved.

It is from what the robot believes, which need not be so.
"""
Minimality: TypeAlias = Choice["proved", "unproved"]
"""Whether it is proved that no explanation is smaller than an adopted one."""


class Explanation(Part, frozen=True, kw_only=True):
    """What makes a history consistent (D 2.4), found at ``step``.

    ``unobserved`` are exogenous actions, ``exceptions`` the literals that hold at step 0 against
    a default, ``distrusted`` reports of what did not happen, attempts of the robot's own that were
    not executed, and fluents that a test was wrong about. ``outcomes`` are actions whose outcome
    was another one than the robot expected, which takes no event. ``minimal`` is ``"unproved"``
    where the budget of the decision was used up before a smaller explanation was ruled out.
    """

    step: Count
    unobserved: Items[Event]
    exceptions: Items[Literal]
    distrusted: Items[Event] = []
    outcomes: Items[Event] = []
    minimal: Minimality = "proved"


class Contradiction(Part, frozen=True, kw_only=True):
    """Something observed at a step against what was believed of it.

    Both are literals; for the result of an attempt, and for news, ``hpd(ACTION)``, ``hpd(-ACTION)``
    where it did not happen, or ``impossible(ACTION)``.
    """

    step: Count
    observed: Text
    believed: Text


class FineTrace(Part, frozen=True, kw_only=True):
    """How an abstract action is carried out at the fine resolution, at one step of it.

    ``abstract`` is the action, None where the robot thinks or finishes; ``begun`` the step at
    which it was begun; ``zoomed`` the coarse constants relevant to it (all of them without
    zooming), and ``plan`` the concrete actions ahead, each given when newly found or made.
    ``plans``, ``actions`` and ``tests`` count refined plans, concrete physical actions and tests
    so far in the trial, the one of this step among them. ``committed`` are fine literals newly
    taken for certain, ``failed`` says in one line what did not come about. When the abstract
    action is over (and another decision is given with the same answer) ``ended`` names it,
    ``inferred`` are the coarse literals that follow from what was observed during it, and
    ``happened`` says whether it had its effects; None while no action is over.
    ``planning_time_s`` is that of zooming and refined plans at this step, ``infer_time_s`` that of
    what follows from observations, both by the wall clock; ``planning_cpu_s`` and ``infer_cpu_s``
    are the same in process time.
    """

    abstract: Action | None = None
    begun: Count | None = None
    zoomed: Items[Text] = []
    plan: Items[Action] = []
    plans: Count = 0
    actions: Count = 0
    tests: Count = 0
    committed: Items[Literal] = []
    failed: Text = ""
    ended: Action | None = None
    inferred: Items[Literal] = []
    happened: bool | None = None
    planning_time_s: Seconds = 0.0
    infer_time_s: Seconds = 0.0
    planning_cpu_s: Seconds = 0.0
    infer_cpu_s: Seconds = 0.0


class Trace(Part, frozen=True, kw_only=True):
    """The mind behind a decision, for records and readers; the environment never acts on it.

    ``mental`` is the mental action of the step (``"start(1)"``, ``"stop(1)"``), ``plan`` the
    physical actions still ahead, that of this step first (empty where the activity is stopped,
    and where the time for the decision ran out), ``belief`` the atoms believed true,
    ``explanation`` is given at the step at which it is newly adopted; with it come
    ``contradictions``, which made it needed, and ``alternatives``, the other explanations that
    are as small (``more_alternatives`` if not all are given; None: the robot does not look for
    them). ``reason`` says why the intention is what it is; where an activity is stopped,
    ``futile_at`` is the first step at which its plan, projected from now on, breaks. ``plans`` is
    the number of activities so far. Times are seconds for this step, without those for reasons:
    ``planning_time_s`` and ``diagnosis_time_s`` by the wall clock, ``planning_cpu_s`` and
    ``diagnosis_cpu_s`` in process time of the robot, its solver included; all four without
    ``preparation_cpu_s``, the process time spent on what other decisions and trials can reuse:
    encoding, grounding, sets of states. At the first step that of beginning the trial is with it.
    ``no_plan`` is given by a robot that gives up. ``minimal`` says whether it is proved, of the
    history up to this step, that no explanation is smaller than the one the decision was made
    under; None: the robot does not tell. ``deadline`` says that the decision was cut off by the
    clock, so that it need not be the same on another machine. ``unheeded`` are the literals that
    the robot sees, does not heed, and believes to be false; None: the robot does not tell.
    ``fine`` is given by robots that act at the fine resolution; the rest is then about the coarse
    one, empty in the steps between the first and the last of an abstract action.
    """

    mental: Action | None = None
    intention: Action | None = None
    activity: Count | None = None
    plan: Items[Action] = []
    belief: Items[Literal] = []
    explanation: Explanation | None = None
    contradictions: Items[Contradiction] = []
    alternatives: Items[Explanation] | None = None
    more_alternatives: bool = False
    futile_at: Count | None = None
    no_plan: NoPlan | None = None
    unheeded: Items[Literal] | None = None
    reason: Text = ""
    minimal: Minimality | None = None
    plans: Count = 0
    planning_time_s: Seconds = 0.0
    diagnosis_time_s: Seconds = 0.0
    planning_cpu_s: Seconds = 0.0
    diagnosis_cpu_s: Seconds = 0.0
    preparation_cpu_s: Seconds = 0.0
    deadline: bool = False
    fine: FineTrace | None = None

    def __post_init__(self) -> None:
        try:
            if self.mental is not None and not is_mental(literal_within_bounds(str, self.mental)):
                raise ValueError(f"{self.mental[:40]!r} neither starts nor stops an activity")
        except ValueError as error:
            raise ValueError(f"mental: {error}") from error
