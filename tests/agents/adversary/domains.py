"""Three domains that share no word with those of the package, with trials in them."""

from pathlib import Path

from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.specs import TrialSpec
from tests.greenhouse import GREENHOUSE

BENCH = GREENHOUSE.replace(
    "R sees stands(P, S) if robot(R).", "R sees stands(P, bench) if robot(R), pot(P)."
)
"""The greenhouse of a gardener who sees no more than which pots stand on the bench."""
LAMPS = """\
sorts
  robot = {porter}.
  lamp  = {red, green}.
  hall  = {west, middle, east}.
fluents
  inertial stays(robot, hall).
  inertial lit(lamp).
  inertial jammed(hall).
actions
  agent     walk(robot, hall).
  agent     light(robot, lamp).
  agent     free(robot, hall).
  exogenous douse(lamp).
  exogenous jam(hall).
laws
  walk(R, H)  causes stays(R, H).
  light(R, L) causes lit(L).
  free(R, H)  causes -jammed(H).
  douse(L)    causes -lit(L).
  jam(H)      causes jammed(H).
  -stays(R, H2) if stays(R, H1), H1 != H2.
  impossible walk(R, H)  if stays(R, H).
  impossible walk(R, H)  if jammed(H).
  impossible light(R, L) if -stays(R, west).
  impossible light(R, L) if lit(L).
  impossible free(R, H)  if -jammed(H).
  impossible douse(L)    if -lit(L).
  impossible jam(H)      if jammed(H).
  impossible jam(H)      if stays(R, H).
initially
  stays(R, H) for some H.
sees
  R sees stays(R, H)  if robot(R).
  R sees lit(L)       if stays(R, west), lamp(L).
  R sees jammed(H)    if stays(R, middle), hall(H).
"""
FERRY = """\
sorts
  robot = {pilot}.
  crate = {oats, salt}.
  bank  = {north, south, isle}.
fluents
  inertial moored(robot, bank).
  inertial lies(crate, bank).
  inertial aboard(crate).
actions
  agent     sail(robot, bank).
  agent     load(robot, crate).
  agent     unload(robot, crate).
  exogenous drag(crate, bank).
laws
  sail(R, B)   causes moored(R, B).
  load(R, C)   causes aboard(C).
  unload(R, C) causes -aboard(C).
  drag(C, B)   causes lies(C, B).
  drag(C, B)   causes -aboard(C).
  lies(C, B) if moored(R, B), aboard(C).
  -moored(R, B2) if moored(R, B1), B1 != B2.
  -lies(C, B2) if lies(C, B1), B1 != B2.
  impossible sail(R, B)   if moored(R, B).
  impossible load(R, C)   if lies(C, B1), moored(R, B2), B1 != B2.
  impossible load(R, C)   if aboard(D).
  impossible unload(R, C) if -aboard(C).
  impossible drag(C, B)   if lies(C, B).
initially
  moored(R, B) for some B.
  lies(C, B) for some B.
sees
  R sees moored(R, B) if robot(R).
  R sees aboard(C)    if robot(R).
  R sees lies(C, B)   if moored(R, B).
"""
PARTS = {
    "bench": (
        BENCH,
        ["stands(fern,sill)", "stands(rose,floor)"],
        ["stands(fern,bench)", "stands(rose,sill)"],
    ),
    "lamps": (LAMPS, ["lit(red)", "lit(green)", "stays(porter,east)"], ["stays(porter,middle)"]),
    "ferry": (
        FERRY,
        ["lies(oats,north)", "-aboard(oats)"],
        ["moored(pilot,isle)", "lies(oats,south)", "lies(salt,isle)"],
    ),
}
"""By the name of a domain: its text, a goal, and what is true at first."""


def spec_in(folder: Path, name: str, *overrides: str) -> TrialSpec:
    """A trial of an intentional robot in one of the domains, others act while it thinks."""
    text, goal, initial = PARTS[name]
    (folder / f"{name}.al").write_text(text, encoding="utf-8")
    config = folder / f"{name}.yaml"
    config.write_text(f"name: {name}\ndomain: {name}.al\nlink: inprocess\n", encoding="utf-8")
    given = [
        f"goal={goal}",
        f"initial={initial}",
        "robots=[intentional]",
        "exogenous_while_thinking=true",
        "limits.steps=14",
    ]
    return plan_trials(load_config(str(config), [*given, *overrides]))[0]
