"""A small domain that shares no word with those of the package."""

GREENHOUSE = """\
sorts
  robot = {gardener}.
  pot   = {fern, rose}.
  spot  = {bench, sill, floor}.
fluents
  inertial stands(pot, spot).
actions
  agent     carry(robot, pot, spot).
  exogenous blow(pot, spot).
laws
  carry(R, P, S) causes stands(P, S).
  blow(P, S)     causes stands(P, S).
  -stands(P, S2) if stands(P, S1), S1 != S2.
  impossible carry(R, P, S) if stands(P, S).
  impossible blow(P, S)     if stands(P, S).
initially
  stands(P, S) for some S.
sees
  R sees stands(P, S) if robot(R).
"""
"""Two pots are carried to where they belong, and the wind blows them elsewhere: no scenarios."""

WINDY = GREENHOUSE + "scenarios\n  calm: nothing.\n  windy: blow(P, S) upon any drawing P.\n"
"""The same with two scenarios."""
