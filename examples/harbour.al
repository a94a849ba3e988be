% A crane moves crates between places in a row, of which it sees everything; lorries move them, too.

sorts
  robot = {crane}.
  crate = {tea, coffee}.
  place = {ship, quay, shed}.

statics
  beside(place, place).

fluents
  inertial over(robot, place).
  inertial at(crate, place).
  inertial hangs(robot, crate).

actions
  agent     swing(robot, place).
  agent     lift(robot, crate).
  agent     lower(robot, crate).
  exogenous haul(crate, place).

laws
  swing(R, P) causes over(R, P).
  lift(R, C)  causes hangs(R, C).
  lower(R, C) causes -hangs(R, C).
  haul(C, P)  causes at(C, P).

  beside(P1, P2)  if beside(P2, P1).
  -over(R, P2)    if over(R, P1), P1 != P2.
  -at(C, P2)      if at(C, P1), P1 != P2.
  at(C, P)        if hangs(R, C), over(R, P).
  -hangs(R, C1)   if hangs(R, C2), C1 != C2.

  impossible swing(R, P)  if over(R, P).
  impossible swing(R, P2) if over(R, P1), -beside(P1, P2).
  impossible lift(R, C1)  if hangs(R, C2).
  impossible lift(R, C)   if at(C, P1), over(R, P2), P1 != P2.
  impossible lower(R, C)  if -hangs(R, C).
  impossible haul(C, P)   if at(C, P).
  impossible haul(C, P)   if hangs(R, C).

facts
  beside(ship, quay).
  beside(quay, shed).

initially
  over(R, P) for some P.
  at(C, P)   for some P.

sees
  R sees over(R, P)  if robot(R).
  R sees hangs(R, C) if robot(R).
  R sees at(C, P)    if robot(R).

shows
  swing(R, P1) shows over(R, P2).
  lift(R, C)   shows hangs(R, C).
  lower(R, C)  shows hangs(R, C).
