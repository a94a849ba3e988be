"""The messages between a driver and a robot: typed, versioned, MessagePack on the wire.

A driver sends a :class:`Question`, the robot answers it with a :class:`Decision`. Everything
logical is ASP text as in the documents: an atom is ``"loc(book1,kitchen)"``, its negation
``"-loc(book1,kitchen)"``; a message that is decoded has it parsed (:class:`asp.language.Literal`).
Steps are the environment's and the history's alike (D 2.3): 0 is the selection of the goal, the
first decision is the one of step 1.
"""

from typing import Any, TypeAlias, TypeVar
from typing import Literal as Choice

import msgspec

from asp.language import Action, Literal
from testbed.protocol.bounds import Count, Items, Seconds, Text, literal_within_bounds
from testbed.protocol.errors import LinkError

PROTOCOL_VERSION = 1

WAIT, FINISH, NONE = map(Action.of, ("wait", "finish", "none"))
"""The actions that are the environment's own: of the robot, and of the adversary."""


def is_mental(action: Action) -> bool:
    """Whether an action starts or stops an activity: `start(N)`, `stop(N)`."""
    parts = action.arguments
    number = parts[0] if len(parts) == 1 else ""
    is_named = action.is_positive and action.name in ("start", "stop")
    return is_named and number.isdecimal() and len(number) < 10


NoPlan: TypeAlias = Choice["out of reach", "beyond the limit", "not known"]
"""Why a robot has no plan: no plan of any length exists, only a longer one, or neither is proved.

It is from what the robot believes, which need not be so.
"""
Relevance: TypeAlias = Choice["published", "definition", "plan", "all"]
"""Which visible literals a robot heeds.

`published`: those of the released controller; `definition`: what is relevant to the action at hand
or to the goal by Definition 1 (P 3.3); `plan`: the conditions of the rest of its plan, too; `all`:
all that it sees.
"""
Plans: TypeAlias = Choice["optimistic", "conformant"]
"""Whether some outcomes of a plan's actions have to reach the goal, or all."""
Minimality: TypeAlias = Choice["proved", "unproved"]
"""Whether it is proved that no explanation is smaller than an adopted one."""


class Part(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Something that travels inside a message."""


class Message(Part, frozen=True, kw_only=True):
    """Something that travels alone, and therefore carries the protocol's version."""

    version: int = PROTOCOL_VERSION


class Task(Part, frozen=True, kw_only=True):
    """What a robot is told once, before its first percept of a trial.

    ``domain`` and ``source`` are the name and the AL_d text of the domain, ``goal`` a list of
    literals, ``initial`` what the robot knows to hold at step 0, perhaps not everything,
    ``plan_limit`` the greatest number of actions in a plan, ``plans`` whether some outcomes of its
    actions have to reach the goal (optimistic), or all (conformant), ``relevance`` which of the
    literals that it sees a robot heeds, if it chooses among them. A decision may take
    ``decision_s`` seconds, so many ``conflicts`` of the solver, ground programs of so many
    ``ground_rules`` and so many ``expansions`` of sets of states; None: any number. Where the
    robot acts at the fine resolution, ``refinement`` is the text that refines ``source``, and
    ``initial_fine`` what it knows there at step 0; ``goal`` and ``initial`` are coarse all the
    same.
    """

    trial: str
    robot: str
    domain: str
    source: str
    goal: list[Literal]
    initial: list[Literal]
    plan_limit: int
    seed: int
    decision_s: float | None = None
    conflicts: int | None = None
    ground_rules: int | None = None
    expansions: int | None = None
    relevance: Relevance = "definition"
    refinement: str = ""
    initial_fine: list[Literal] = []
    plans: Plans = "optimistic"


class Event(Part, frozen=True, kw_only=True):
    """An action at a step of the history."""

    step: Count
    action: Literal


class Percept(Part, frozen=True, kw_only=True):
    """What the robot is told at ``step``, before it decides what to attempt there.

    ``visible`` are the literals it sees now, ``doubtful`` those of them that rest on tests which
    may have been wrong; ``attempted`` and ``happened`` its attempt at the previous step and whether
    it took effect (both None where it attempted nothing), ``failing`` whether the attempt was
    carried out in vain: it need not have been impossible; ``events`` the exogenous actions that it
    is told of now, each with the earlier step at which it is said to have happened; ``goal_holds``
    is False after a ``finish`` that the goal did not bear out, None when nothing is said about the
    goal.
    """

    trial: str
    step: int
    visible: list[Literal]
    doubtful: list[Literal] = []
    attempted: Action | None = None
    happened: bool | None = None
    failing: bool = False
    events: list[Event] = []
    goal_holds: bool | None = None


class Question(Message, frozen=True, kw_only=True):
    """What the driver asks: a percept, and with the first one of a trial its task."""

    percept: Percept
    task: Task | None = None


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
    are as small (``more_alternatives`` if not all are given). ``reason`` says why the intention
    is what it is; where an activity is stopped, ``futile_at`` is the first step at which its
    plan, projected from now on, breaks. ``plans`` is the number of activities so far. Times are
    seconds for this step, without those for reasons: ``planning_time_s`` and
    ``diagnosis_time_s`` by the wall clock, ``planning_cpu_s`` and ``diagnosis_cpu_s`` in
    process time of the robot, its solver included; all four without ``preparation_cpu_s``, the
    process time spent on what other decisions and trials can reuse: encoding, grounding, sets
    of states. At the first step that of beginning the trial is with it. ``no_plan`` is given by
    a robot that gives up. ``minimal`` says whether it is proved, of the history up to this step,
    that no explanation is smaller than the one the decision was made under; None: the robot does
    not tell. ``deadline`` says that the decision was cut off by the clock, so that it need not be
    the same on another machine. ``unheeded`` are the literals that the robot sees, does not heed,
    and believes to be false; None: the robot does not tell.
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
    alternatives: Items[Explanation] = []
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


class Decision(Message, frozen=True, kw_only=True):
    """The robot's answer at a step: a ground physical action, ``"wait"`` or ``"finish"``.

    ``stopped`` is the reason, in one line, of a robot that cannot go on: the trial is over then.
    """

    trial: Text
    step: Count
    action: Action
    believes_goal: bool
    trace: Trace
    stopped: Text | None = None


class _Envelope(msgspec.Struct):
    """The one field that every version of every message has; here it has no default."""

    version: int


M = TypeVar("M", bound=Message)

_encoder = msgspec.msgpack.Encoder(enc_hook=str)
_envelope = msgspec.msgpack.Decoder(_Envelope)
# Made here: msgspec reads what a type holds when it first needs it, and two threads that do so at
# once end the interpreter.
_decoders: dict[type[Message], msgspec.msgpack.Decoder[Any]] = {
    kind: msgspec.msgpack.Decoder(kind, dec_hook=literal_within_bounds)
    for kind in Message.__subclasses__()
}


def encode(message: Message) -> bytes:
    """Return the bytes of a message."""
    return _encoder.encode(message)


def decode(payload: bytes, kind: type[M]) -> M:
    """Return the message of type ``kind`` in ``payload``.

    Raises LinkError, with one line that says what is wrong, for another protocol version or for
    anything that is not a message of this type within its bounds.
    """
    try:
        version = _envelope.decode(payload).version
        if version != PROTOCOL_VERSION:
            raise LinkError(f"protocol version {version}, understood is {PROTOCOL_VERSION}")
        message: M = _decoders[kind].decode(payload)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise LinkError(f"not a {kind.__name__}: {error}") from error
    return message
