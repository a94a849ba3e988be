"""Small random descriptions, in many of which an action has several outcomes."""

from hypothesis import assume
from hypothesis import strategies as st

from asp import SourceError, parse_description
from asp.language import Description

INERTIAL, DEFINED = ("wet", "up", "lit", "full"), ("fine",)
OWN, OTHERS = ("tip", "wipe", "lift"), ("gust",)
_SIGNS = st.sampled_from(["", "-"])
_LITERALS = st.builds("{}{}".format, _SIGNS, st.sampled_from(INERTIAL + DEFINED))
_EFFECTS = st.builds("{}{}".format, _SIGNS, st.sampled_from(INERTIAL))
_BODIES = st.lists(_LITERALS, max_size=2, unique_by=lambda literal: literal.strip("-"))


def _law(head: str, body: list[str]) -> str:
    return f"  {head}{' if ' * bool(body)}{', '.join(body)}."


@st.composite
def _either(draw: st.DrawFn) -> list[str]:
    """Where an action makes a third literal true, one of two gives way to it: which is open."""
    names = draw(st.permutations(INERTIAL))[:3]
    a, b, c = (draw(_SIGNS) + name for name in names)
    cause = f"  {draw(st.sampled_from(OWN + OTHERS))} causes {c}."
    return [_law(_not(a), [b, c]), _law(_not(b), [a, c]), cause]


def _not(literal: str) -> str:
    return literal[1:] if literal.startswith("-") else f"-{literal}"


@st.composite
def texts(draw: st.DrawFn) -> str:
    """An AL_d text with actions, constraints, a defined fluent and executability conditions."""
    laws = [
        _law(f"{action} causes {effect}", draw(st.lists(_LITERALS, max_size=1)))
        for action in OWN + OTHERS
        for effect in draw(st.lists(_EFFECTS, min_size=1, max_size=2, unique=True))
    ]
    laws += [law for some in draw(st.lists(_either(), max_size=2)) for law in some]
    laws += [_law(draw(_EFFECTS), body) for body in draw(st.lists(_BODIES, max_size=1)) if body]
    laws += [_law("fine", body) for body in draw(st.lists(_BODIES, max_size=2)) if body]
    laws += [_law(draw(_EFFECTS), ["-fine"])] * draw(st.booleans())
    laws += [
        _law(f"impossible {draw(st.sampled_from(OWN))}", body)
        for body in draw(st.lists(_BODIES, max_size=2))
        if body
    ]
    lines = ["fluents", *(f"  inertial {name}." for name in INERTIAL)]
    lines += [f"  defined {name}." for name in DEFINED]
    lines += ["actions", *(f"  agent {name}." for name in OWN)]
    lines += [*(f"  exogenous {name}." for name in OTHERS), "laws", *laws, ""]
    return "\n".join(lines)


@st.composite
def descriptions(draw: st.DrawFn) -> Description:
    """One with a text that is allowed."""
    try:
        found = parse_description(draw(texts()), "random.al")
    except SourceError:
        assume(False)
        raise
    return found


DIE = """
sorts
  robot = {hand}.
  face  = {one, two, three}.
fluents
  inertial up(face).
  inertial thrown.
actions
  agent grab.
  agent throw.
laws
  grab  causes -thrown.
  grab  causes up(F).
  throw causes thrown.
  -up(F) if up(G), thrown, F != G.
  impossible grab  if -thrown.
  impossible throw if thrown.
sees
  R sees up(F) if robot(R).
  R sees thrown if robot(R).
"""
"""In the hand every face may come up; one does when it is thrown."""

DOOR = """
sorts
  robot = {porter}.
fluents
  inertial pulled.
  inertial shut.
  inertial loose.
  inertial outside.
actions
  agent pull.
  agent let_go.
  agent oil.
  agent leave.
  exogenous slam.
laws
  pull   causes pulled.
  let_go causes -pulled.
  oil    causes loose.
  slam   causes shut.
  leave  causes outside.
  -shut  if pulled, loose.
  -loose if pulled, shut.
  impossible pull   if pulled.
  impossible let_go if -pulled.
  impossible oil    if loose.
  impossible oil    if pulled.
  impossible leave  if shut.
  impossible slam   if pulled.
  impossible slam   if shut.
sees
  R sees shut if robot(R).
  R sees pulled if robot(R).
"""
"""A door that is pulled opens, or sticks: then it is not loose any longer."""

RESTLESS = """
sorts
  robot = {guard}.
fluents
  inertial awake.
  defined  alert.
actions
  agent wake.
laws
  wake causes awake.
  alert  if awake.
  -awake if -alert.
sees
  R sees awake if robot(R).
"""
"""Who is awake may fall asleep while nothing is done."""

CRATES = """
sorts
  robot = {crane}.
  crate = {small, large}.
fluents
  inertial tied(crate).
  inertial high(crate).
  inertial whole(crate).
  inertial tilted(crate).
actions
  agent tip(crate).
  agent tie(crate).
  agent lower(crate).
laws
  tip(C)   causes tilted(C).
  tie(C)   causes tied(C).
  lower(C) causes -high(C).
  -high(C)  if tilted(C), whole(C).
  -whole(C) if tilted(C), high(C).
  impossible lower(C) if -tied(C).
  impossible tip(C)   if tilted(C).
sees
  R sees high(C) if robot(R).
  R sees whole(C) if robot(R).
  R sees tilted(C) if robot(R).
"""
"""A crate that is tipped over may break instead of coming down; one that is lowered does not."""
