"""The zenoh keys of the testbed, in one place.

    testbed/v1/<run>/<trial>/<agent>/act     queryable: a question, answered with a decision
    testbed/v1/<run>/<trial>/<agent>/alive   liveliness: the agent is in this trial
    testbed/v1/<run>/<trial>/<agent>/trace   published: every decision of the trial
    testbed/v1/robots/<name>                 liveliness: a robot that offers to serve

Ids are quoted, so that any text may name a run, a trial or a robot.
"""

from urllib.parse import quote

ROOT = "testbed/v1"
ROBOT = "robot_0"
ADDRESSEE = "robot"


def chunk(text: str) -> str:
    """Return ``text`` as one chunk of a key. Raises ValueError when it is empty."""
    if not text:
        raise ValueError("a run, a trial and a robot need a name for their zenoh key")
    return quote(text, safe="")


def act(run: str, trial: str) -> str:
    """The key on which the robot of a trial is asked."""
    return f"{ROOT}/{chunk(run)}/{chunk(trial)}/{ROBOT}/act"


def acts() -> str:
    """The key expression of every question to a robot, in any run."""
    return f"{ROOT}/*/*/{ROBOT}/act"


def question(run: str, trial: str, name: str) -> str:
    """The selector of a question to one robot, where several may hear it."""
    return f"{act(run, trial)}?{ADDRESSEE}={chunk(name)}"


def alive(act_key: str) -> str:
    """The liveliness key that goes with a key to ask on."""
    return act_key.removesuffix("act") + "alive"


def trace(act_key: str) -> str:
    """The key on which the decisions given at ``act_key`` are published."""
    return act_key.removesuffix("act") + "trace"


def robot(name: str) -> str:
    """The liveliness key of a robot that offers to serve."""
    return f"{ROOT}/robots/{chunk(name)}"
