"""A robot that plays faults, chosen by ``Task.robot``, and what to ask it.

Run as a module it serves itself.
"""

import argparse
import os
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from testbed.link import serve_forever
from testbed.protocol import Decision, Percept, RobotStops, Task, Trace

COMMAND = (sys.executable, "-m", "tests.link.scripted")
PATIENCE_S = 600.0
"""An answer limit no test should ever meet."""


def task(kind: str, trial: str = "t1") -> Task:
    """A task for a scripted robot of this kind."""
    return Task(
        trial=trial,
        robot=kind,
        domain="toy",
        source="sorts\n",
        goal=["lit(lamp)"],
        initial=["-lit(lamp)"],
        plan_limit=5,
        seed=1,
    )


def percept(step: int = 1, trial: str = "t1") -> Percept:
    """What a robot is told at a step."""
    return Percept(trial=trial, step=step, visible=["-lit(lamp)"])


def decision(percept: Percept, **changes: Any) -> Decision:
    """A sound answer to a percept: the action tells the process, the trace its steps."""
    sound = Decision(
        trial=percept.trial,
        step=percept.step,
        action=f"served_by({os.getpid()})",
        believes_goal=False,
        trace=Trace(belief=percept.visible),
    )
    return msgspec.structs.replace(sound, **changes)


def _raise(_: Percept) -> Decision:
    raise ArithmeticError("out of\nideas")


def _stop(_: Percept) -> Decision:
    raise RobotStops("nothing explains what was seen")


def _die(_: Percept) -> Decision:
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError("unreachable")


def _exit(_: Percept) -> Decision:
    print("Traceback:\nOSError: no space left", file=sys.stderr, flush=True)
    os._exit(3)


def _think(_: Percept) -> Decision:
    print("thinking", flush=True)
    time.sleep(600)
    raise AssertionError("nobody waits this long")


def _held(percept: Percept) -> Decision:
    """Answer when a file `go` is there; one called `asked` says that the question is."""
    Path("asked").touch()
    while not Path("go").exists():
        time.sleep(0.01)
    return decision(percept)


BEHAVIOURS: dict[str, Callable[[Percept], Any]] = {
    "sound": decision,
    "raising": _raise,
    "stopping": _stop,
    "dying": _die,
    "exiting": _exit,
    "thinking": _think,
    "held": _held,
    "babbling": lambda _: msgspec.Raw(b"\xc1 no MessagePack starts like this"),
    "foreign": lambda _: {"version": 1, "action": "wait"},
    "newer": lambda percept: decision(percept, version=2),
    "late": lambda percept: decision(percept, step=percept.step - 1),
    "elsewhere": lambda percept: decision(percept, trial="another"),
    "timeless": lambda percept: decision(percept, trace=Trace(planning_time_s=float("nan"))),
    "nested": lambda _: msgspec.Raw(b"\x82\xa7version\x01\xa5trace" + b"\x91" * 10**6 + b"\xc0"),
    "verbose": lambda percept: decision(percept, action="x" * 10**7),
}


class ScriptedRobot:
    """Does what its kind says at every percept."""

    def __init__(self, kind: str) -> None:
        self._behave = BEHAVIOURS[kind]

    def begin(self, task: Task) -> None:
        """Nothing to prepare."""

    def act(self, percept: Percept) -> Any:
        """Behave, or misbehave."""
        return self._behave(percept)


def main() -> None:
    """Serve with the options that every robot command takes."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--connect", required=True)
    parser.add_argument("--name", required=True)
    options = parser.parse_args()
    serve_forever(options.connect, options.name, ScriptedRobot)


if __name__ == "__main__":
    main()
