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
