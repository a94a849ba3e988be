"""A garden with two tools, and refinements of it; OTHER is the name of one of the tools."""

GARDEN = """
sorts
  bed    = {north, south}.
  helper = {tom}.
  tool   = {OTHER, spade}.
  thing  = helper + tool.
statics
  beside(bed, bed).
fluents
  inertial stands(thing, bed).
  inertial carries(helper, tool).
actions
  agent     walk(helper, bed).
  agent     lift(helper, tool).
  agent     lay(helper, tool).
  exogenous stray(tool, bed).
laws
  walk(H, B)  causes stands(H, B).
  lift(H, T)  causes carries(H, T).
  lay(H, T)   causes -carries(H, T).
  stray(T, B) causes stands(T, B).
  beside(A, B) if beside(B, A).
  -stands(X, B2) if stands(X, B1), B1 != B2.
  stands(T, B) if stands(H, B), carries(H, T).
  -carries(H, T1) if carries(H, T2), T1 != T2.
  impossible walk(H, B)  if stands(H, B).
  impossible walk(H, B)  if stands(H, A), -beside(A, B).
  impossible lift(H, T)  if carries(H, T2).
  impossible lift(H, T)  if stands(H, A), stands(T, B), A != B.
  impossible lay(H, T)   if -carries(H, T).
  impossible stray(T, B) if stands(T, B).
  impossible stray(T, B) if carries(H, T).
facts
  beside(north, south).
initially
  stands(X, B) for some B.
sees
  H sees stands(X, B) if helper(H), stands(H, B).
  H sees carries(H, T).
scenarios
  1: nothing.
"""

PIECES = """
refines "own.al".
magnify
  bed into row.
  tool into piece.
components
  north = {north_1, north_2}.
  south = {south_1, south_2}.
  OTHER = {other_head, other_shaft}.
  spade = {spade_head, spade_shaft}.
counterparts
  beside. stands. carries. walk. lift. lay. stray.
facts
  fine_beside(north_1, north_2).
  fine_beside(north_2, south_1).
  fine_beside(south_1, south_2).
laws
  fine_stands(P1, C) if fine_stands(P2, C), component(P1, O), component(P2, O).
tests
  H tests fine_stands(X, C) if helper(H), fine_stands(H, C).
  H tests fine_carries(H, P).
"""

ROWS = """
refines "own.al".
magnify
  bed into row.
components
  north = {north_1, north_2}.
  south = {south_1, south_2}.
counterparts
  beside. stands. walk. stray.
facts
  fine_beside(north_1, north_2).
  fine_beside(north_2, south_1).
  fine_beside(south_1, south_2).
tests
  H tests fine_stands(X, C) if helper(H), fine_stands(H, C).
"""
