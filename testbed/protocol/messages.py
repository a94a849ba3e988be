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
from testbed.protocol.bounds import Count, Text, literal_within_bounds
from testbed.protocol.errors import LinkError
from testbed.protocol.parts import Event, Part
from testbed.protocol.trace import Trace

PROTOCOL_VERSION = 1

Relevance: TypeAlias = Choice["published", "definition", "plan", "all"]
"""Which visible literals a robot heeds.

`published`: those of the released controller; `definition`: what is relevant to the action at hand
or to the goal by Definition 1 (P 3.3); `plan`: the conditions of the rest of its plan, too; `all`:
all that it sees.
"""
Plans: TypeAlias = Choice["optimistic", "conformant"]
"""Whether some outcomes of a plan's actions have to reach the goal, or all."""


class Message(Part, frozen=True, kw_only=True):
    """Something that travels alone, and therefore carries the protocol's version."""

    version: int = PROTOCOL_VERSION


class Task(Part, frozen=True, kw_only=True):
    """What a robot is told once, before its first percept of a trial.

    ``domain`` and ``source`` are the name and the AL_d text of the domain, ``goal`` a list of
    literals, ``initial`` what the robot knows to hold at step 0, perhaps not everything,
    ``plan_limit`` the greatest number of actions in a plan, ``plans`` whether some outcomes of its
    actions have to reach the goal (optimistic), or all (conformant), ``relevance`` which of the
    literals that it sees a robot heeds, if it chooses among them; ``ties`` is the seed of the order
    in which it chooses among equally small explanations, None: that of declaration. A decision may
    take ``decision_s`` seconds, so many ``conflicts`` of the solver, ground programs of so many
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
    ties: int | None = None


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
