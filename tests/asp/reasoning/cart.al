% A cart on a track with two sides, a gate between them, and a lamp.
sorts
  side = {left, right}.

fluents
  inertial at(side).
  inertial shut.
  inertial lit.
  defined  safe.

actions
  agent     open.
  agent     go(side).
  agent     switch_on.
  exogenous push(side).
  exogenous shut_gate.

laws
  go(S)     causes at(S).
  push(S)   causes at(S).
  open      causes -shut.
  shut_gate causes shut.
  switch_on causes lit.

  -at(S1) if at(S2), S1 != S2.
  safe    if lit, -shut.

  impossible go(S)     if at(S).
  impossible go(S)     if shut.
  impossible push(S)   if at(S).
  impossible open      if -shut.
  impossible shut_gate if shut.
  impossible switch_on if lit.
