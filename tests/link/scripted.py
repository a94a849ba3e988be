"""A robot that plays faults, chosen by ``Task.robot``; run as a module it serves itself."""

import argparse
import os
import signal
import sys
import time
from collections.abc import Callable
from typing import Any

import msgspec

from testbed.link.messages import Decision, Percept, Task, Trace
from testbed.link.serve import serve_forever

COMMAND = (sys.executable, "-m", "tests.link.scripted")


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


def _raise(percept: Percept) -> Decision:
    raise ArithmeticError("out of\nideas")


def _die(percept: Percept) -> Decision:
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError("unreachable")


def _exit(percept: Percept) -> Decision:
    print("Traceback:\nOSError: no space left", file=sys.stderr, flush=True)
    os._exit(3)


def _think(percept: Percept) -> Decision:
    print("thinking", flush=True)
    time.sleep(600)
    raise AssertionError("nobody waits this long")


BEHAVIOURS: dict[str, Callable[[Percept], Any]] = {
    "sound": decision,
    "raising": _raise,
    "dying": _die,
    "exiting": _exit,
    "thinking": _think,
    "babbling": lambda percept: msgspec.Raw(b"\xc1 no MessagePack starts like this"),
    "foreign": lambda percept: {"version": 1, "action": "wait"},
    "newer": lambda percept: decision(percept, version=2),
    "late": lambda percept: decision(percept, step=percept.step - 1),
    "elsewhere": lambda percept: decision(percept, trial="another"),
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
