"""What `testbed explain` lists of an initial state, and of very many explanations."""

from pathlib import Path

import pytest
from click.testing import Result
from typer.testing import CliRunner

import asp
from testbed.cli import app

WARDS = """
% Trolleys in the wards of a hospital.
sorts
  ward    = {east, west, north, south}.
  trolley = {linen, insulin}.
fluents
  inertial at(trolley, ward).
  inertial lit(ward).
actions
  agent     push(trolley, ward).
  exogenous borrow(trolley, ward).
laws
  push(T, W)   causes at(T, W).
  borrow(T, W) causes at(T, W).
  -at(T, W1) if at(T, W2), W1 != W2.
  impossible push(T, W)   if at(T, W).
  impossible borrow(T, W) if at(T, W).
initially
  at(T, W) for some W.
"""
BELLS = """
sorts
  bell = {bells}.
fluents
  inertial noisy.
actions
  agent     listen.
  exogenous ring(bell).
laws
  ring(B) causes noisy.
  impossible listen if noisy.
"""


def _explained(text: str, history: str, *options: str) -> Result:
    Path("some.al").write_text(text, encoding="utf-8")
    Path("told.yaml").write_text(history, encoding="utf-8")
    return CliRunner().invoke(app, ["explain", "some.al", "told.yaml", *options])


@pytest.mark.usefixtures("at_home")
@pytest.mark.parametrize(
    ("seen", "assumed"),
    [
        # Where the linen is decides where it is not; the insulin has to be somewhere, so that it is
        # in the first ward. Where the lights are off nothing says.
        (
            "at(linen,north), -lit(east), -lit(west)",
            {"at(insulin,east)", "-lit(north)", "-lit(south)"},
        ),
        # It has to be in the only ward that is left.
        (
            "at(linen,north), -at(insulin,east), -at(insulin,west), -at(insulin,north), lit(east)",
            {"-lit(west)", "-lit(north)", "-lit(south)"},
        ),
    ],
)
def test_what_follows_of_the_initial_state_is_not_listed(seen: str, assumed: set[str]) -> None:
    told = f'history:\n- observed: ["{seen}"]\n- observed: ["at(linen,west)"]\n'.replace(
        ", ", '", "'
    )
    result = _explained(WARDS, told)
    assert result.exit_code == 0
    lines = set(result.stdout.splitlines())
    assert lines == {"step 0: borrow(linen,west) happened", *(f"step 0: {own}" for own in assumed)}
    history = [asp.Step(observed=seen), asp.Step(observed="at(linen,west)")]
    assert set(asp.load("some.al").explain(history).initial) == assumed


@pytest.mark.usefixtures("at_home")
def test_explanations_that_are_not_listed_are_said_to_be_there() -> None:
    """Any of 300 bells rang at one of 4 steps, or of 240: the latter are 960."""
    told = 'history:\n- observed: ["-noisy"]\n- {}\n- {}\n- {}\n- observed: [noisy]\n'
    for number, more in ((300, 1), (240, 0)):
        bells = ", ".join(f"b{bell}" for bell in range(number))
        result = _explained(BELLS.replace("bells", bells), told, "--all")
        assert result.exit_code == 0
        assert result.stdout.count(" happened\n") == min(1000, 4 * number)
        warned = result.stderr.splitlines()
        assert len(warned) == more
        assert all("1000" in line for line in warned)
