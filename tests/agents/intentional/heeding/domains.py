"""Domains that share no word with those of the package, each for one way of being relevant."""

BLOCKS = """\
sorts
  robot = {gripper}.
  cube  = {a, b, c}.
  base  = cube + {ground}.
fluents
  inertial on(cube, base).
  defined  above(cube, base).
actions
  agent     put(cube, base).
  exogenous knock(cube, base).
laws
  put(C, B)    causes on(C, B).
  knock(C, B)  causes on(C, B).
  -on(C, B2)   if on(C, B1), B1 != B2.
  -on(C2, B)   if on(C1, B), C1 != C2, cube(B).
  above(C2, B) if on(C2, B).
  above(C2, B) if on(C2, C1), above(C1, B).
  impossible put(C, B)   if on(C1, C).
  impossible put(C, B)   if on(C1, B), cube(B).
  impossible put(C, C).
  impossible knock(C, B) if on(C, B).
  impossible knock(C, B) if on(C1, C).
  impossible knock(C, B) if on(C1, B), cube(B).
  impossible knock(C, C).
initially
  on(C, B) for some B.
sees
  R sees on(C, B) if robot(R).
"""
"""Of a goal that is a defined fluent nothing is seen but what it is defined by."""

CANAL = """\
sorts
  robot = {barge}.
  pool  = {spring, mill, delta, gulf}.
  gate  = {weir}.
statics
  joins(pool, pool).
  shuts(gate, pool, pool).
fluents
  inertial floats(robot, pool).
  inertial closed(gate).
  inertial dredged(pool).
actions
  agent     sail(robot, pool).
  agent     crank(robot, gate).
  exogenous turn(gate).
  exogenous dredge(pool).
laws
  sail(R, P)     causes floats(R, P).
  crank(R, G)    causes -closed(G).
  turn(G)        causes closed(G) if -closed(G).
  turn(G)        causes -closed(G) if closed(G).
  dredge(P)      causes dredged(P).
  -floats(R, P2) if floats(R, P1), P1 != P2.
  joins(P2, P1)  if joins(P1, P2).
  impossible sail(R, P)   if floats(R, P).
  impossible sail(R, P2)  if floats(R, P1), -joins(P1, P2).
  impossible sail(R, P2)  if floats(R, P1), shuts(G, P1, P2), closed(G).
  impossible crank(R, G)  if -closed(G).
  impossible dredge(P)    if dredged(P).
facts
  joins(spring, mill).
  joins(mill, delta).
  joins(delta, gulf).
  shuts(weir, mill, delta).
initially
  floats(R, P) for some P.
sees
  R sees floats(R, P) if robot(R).
  R sees closed(G)    if robot(R).
  R sees dredged(P)   if robot(R).
"""
"""A gate on the way is in plain sight, and no goal and no early action names it."""

SMITHY = """\
sorts
  robot  = {smith}.
  helper = {apprentice}.
  spot   = {anvil, yard}.
  piece  = {blade}.
fluents
  inertial waits(helper, spot).
  inertial hot(piece).
  inertial forged(piece).
  inertial cracked(spot).
actions
  agent     heat(robot, piece).
  agent     strike(robot, piece).
  agent     call(robot, helper).
  exogenous stroll(helper, spot).
  exogenous crack(spot).
laws
  heat(R, P)    causes hot(P).
  strike(R, P)  causes forged(P).
  call(R, H)    causes waits(H, anvil).
  stroll(H, S)  causes waits(H, S).
  crack(S)      causes cracked(S).
  -waits(H, S2) if waits(H, S1), S1 != S2.
  impossible heat(R, P)   if hot(P).
  impossible strike(R, P) if -hot(P).
  impossible strike(R, P) if forged(P).
  impossible strike(R, P) if -waits(H, anvil).
  impossible call(R, H)   if waits(H, anvil).
  impossible stroll(H, S) if waits(H, S).
  impossible crack(S)     if cracked(S).
initially
  waits(H, S) for some S.
sees
  R sees waits(H, S) if robot(R).
  R sees hot(P)      if robot(R).
  R sees forged(P)   if robot(R).
  R sees cracked(S)  if robot(R).
"""
"""A helper has to be there for the second of two actions."""
_NEEDED = "  impossible strike(R, P) if -waits(H, anvil).\n"
IN_THE_EFFECT = SMITHY.replace(_NEEDED, "").replace(
    "strike(R, P)  causes forged(P).", "strike(R, P)  causes forged(P) if waits(apprentice, anvil)."
)
"""The same where the action is possible without the helper, and has no effect."""
BY_A_DEFINITION = SMITHY.replace(
    _NEEDED, "  impossible strike(R, P) if -ready(H).\n  ready(H) if waits(H, anvil).\n"
).replace("  inertial hot(piece).\n", "  inertial hot(piece).\n  defined  ready(helper).\n")
"""The same with a defined fluent as the condition."""

PORT = """\
sorts
  robot = {{pilot}}.
  ship  = {{brig}}.
  berth = {{east, north, west, south}}.
statics
  beside(berth, berth).
fluents
  inertial stands(robot, berth).
  inertial aboard(robot, ship).
  inertial moors({sorts}).
actions
  agent     walk(robot, berth).
  agent     board(robot, ship).
  exogenous tow(ship, berth).
laws
  walk(R, B)     causes stands(R, B).
  board(R, S)    causes aboard(R, S).
  tow(S, B)      causes moors({first}).
  -stands(R, B2) if stands(R, B1), B1 != B2.
  -moors({second}) if moors({first}), B != B2.
  beside(B2, B1) if beside(B1, B2).
  impossible walk(R, B)   if stands(R, B).
  impossible walk(R, B2)  if stands(R, B1), -beside(B1, B2).
  impossible walk(R, B)   if aboard(R, S).
  impossible board(R, S)  if aboard(R, S).
  impossible board(R, S)  if stands(R, B2), moors({first}), B != B2.
  impossible tow(S, B)    if moors({first}).
facts
  beside(east, north).
  beside(north, west).
  beside(west, south).
initially
  stands(R, B) for some B.
  moors({first}) for some B.
sees
  R sees stands(R, B)   if robot(R).
  R sees aboard(R, S)   if robot(R).
  R sees moors({first}) if robot(R), stands(R, B).
  R sees moors({first}) if robot(R), stands(R, B2), beside(B, B2).
"""
"""A pilot looks for a ship, which a goal names without its berth, and sees the berths beside it."""

DITCHES = """\
sorts
  robot = {farmer}.
  valve = {inlet, outlet}.
  ditch = {upper, lower}.
fluents
  inertial opened(valve).
  defined  flows(ditch).
actions
  agent     unscrew(robot, valve).
  exogenous clog(valve).
laws
  unscrew(R, V) causes opened(V).
  clog(V)       causes -opened(V).
  flows(upper)  if opened(inlet).
  flows(lower)  if flows(upper), opened(outlet).
  impossible unscrew(R, V) if opened(V).
  impossible clog(V)       if -opened(V).
sees
  R sees opened(V) if robot(R).
"""
"""The goal depends by two definitions on a valve that no action of the plan names."""


def port(*places: str) -> str:
    """The port whose ships moor so: the places of the fluent, the berth being its value."""
    names = {"S": "ship", "B": "berth", "R": "robot"}
    return PORT.format(
        sorts=", ".join(names[place] for place in places),
        first=", ".join(places),
        second=", ".join("B2" if place == "B" else place for place in places),
    )
