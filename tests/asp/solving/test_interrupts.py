"""An interrupt reaches Python wherever it comes in a call of the solver, and the control is usable.

The signal is sent from within, so that it comes at exactly this place, however loaded the machine.
"""

import subprocess
import sys
from pathlib import Path

import pytest

# Eight pigeons and seven holes take more conflicts than a call that blocks may have.
PROGRAM = """
import os, signal, sys
import clingo
from asp.solving import answer_sets, first_model, ground

PIGEONS = '''
{{ crowd }}.
1 {{ at(P,H) : H = 1..7 }} 1 :- P = 1..8, crowd.
:- at(P,H), at(Q,H), P < Q.
#show crowd/0.
'''
CROWD = clingo.Function("crowd")
place, moment, number = {place!r}, {moment!r}, signal.{signal}
owner = clingo.Control if place in ("solve", "ground") else clingo.SolveHandle
real = getattr(owner, place)
left = [1]


def disturbed(self, *args, **kwargs):
    background = place != "solve" or kwargs.get("async_") == {background}
    if moment == "before" and background and left and left.pop():
        os.kill(os.getpid(), number)
    result = real(self, *args, **kwargs)
    if moment == "after" and background and left and left.pop():
        os.kill(os.getpid(), number)
    return result


def terminate(number, frame):
    raise KeyboardInterrupt


signal.signal(signal.SIGTERM, terminate)
control = ground([PIGEONS], {{}}, [])
setattr(owner, place, disturbed)
try:
    first_model(control, [(CROWD, True)])
except KeyboardInterrupt:
    print("interrupted", first_model(control, [(CROWD, False)]), answer_sets(control))
    print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)
    print(signal.getsignal(signal.SIGTERM) is terminate)
"""


@pytest.mark.parametrize("number", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("moment", ["before", "after"])
@pytest.mark.parametrize(
    ("place", "background"),
    [
        ("solve", True),
        ("solve", None),
        ("wait", True),
        ("model", True),
        ("get", True),
        ("__exit__", True),
    ],
)
def test_an_interrupt_at_any_place_leaves_a_control_usable(
    place: str, background: bool | None, moment: str, number: str
) -> None:
    program = PROGRAM.format(place=place, moment=moment, signal=number, background=background)
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        cwd=Path(__file__).parents[3],
        timeout=300,
        check=False,
    )
    assert done.stdout.splitlines() == ["interrupted () ([()], False)", "True", "True"], done.stderr


SWITCHING = """
import os, signal
import clingo
from asp.solving import Session
from asp.solving import fact, first_model

ATOMS = [fact("light", number) for number in range(6)]
kept = Session("#external light(0..5). #show light/1.", "order", [], [], n=1)
kept.switch_on(*ATOMS[:3])
real = clingo.Control.assign_external
left = [0] * {calls} + [1]


def disturbed(self, *args):
    real(self, *args)
    if left and left.pop(0):
        os.kill(os.getpid(), signal.SIGINT)


clingo.Control.assign_external = disturbed
try:
    kept.switch_on(*ATOMS[3:])
except KeyboardInterrupt:
    kept.switch_on(*ATOMS[2:4])
    print(sorted(map(str, first_model(kept.control))))
"""


@pytest.mark.parametrize("calls", range(6))
def test_a_control_that_is_interrupted_while_it_is_switched_is_switched_right(calls: int) -> None:
    done = subprocess.run(
        [sys.executable, "-c", SWITCHING.format(calls=calls)],
        capture_output=True,
        text=True,
        cwd=Path(__file__).parents[3],
        timeout=300,
        check=False,
    )
    assert done.stdout == "['light(2)', 'light(3)']\n", done.stderr
