% A table with three zones in a row, blocks on it, and an arm over it that moves one block at a time.

sorts
  zone  = {red, green, yellow}.
  arm   = {left_arm}.
  block = {block1, block2}.
  hue   = {blue, white}.

statics
  beside(zone, zone).
  colour(block, hue).

fluents
  inertial over(arm, zone).
  inertial lies(block, zone).
  inertial held(arm, block).
  inertial covered(zone).
  defined  delivered(block).

actions
  agent     swing(arm, zone).
  agent     grasp(arm, block).
  agent     release(arm, block).
  agent     uncover(arm, zone).
  exogenous shove(block, zone).
  exogenous cover(zone).

laws
  swing(A, Z)   causes over(A, Z).
  grasp(A, B)   causes held(A, B).
  release(A, B) causes -held(A, B).
  uncover(A, Z) causes -covered(Z).
  shove(B, Z)   causes lies(B, Z).
  cover(Z)      causes covered(Z).

  beside(Z1, Z2) if beside(Z2, Z1).
  -over(A, Z2)   if over(A, Z1), Z1 != Z2.
  -lies(B, Z2)   if lies(B, Z1), Z1 != Z2.
  lies(B, Z)     if over(A, Z), held(A, B).
  -held(A, B1)   if held(A, B2), B1 != B2.
  delivered(B)   if lies(B, yellow), -held(left_arm, B).

  impossible swing(A, Z)    if over(A, Z).
  impossible swing(A, Z2)   if over(A, Z1), -beside(Z1, Z2).
  impossible grasp(A, B1)   if held(A, B2).
  impossible grasp(A, B)    if over(A, Z1), lies(B, Z2), Z1 != Z2.
  impossible grasp(A, B)    if lies(B, Z), covered(Z).
  impossible release(A, B)  if -held(A, B).
  impossible uncover(A, Z)  if -covered(Z).
  impossible uncover(A, Z1) if over(A, Z2), Z1 != Z2.
  impossible shove(B, Z)    if lies(B, Z).
  impossible shove(B, Z)    if held(A, B).
  impossible shove(B, Z)    if over(A, Z).
  impossible cover(Z)       if covered(Z).

facts
  beside(red, green).
  beside(green, yellow).
  colour(block1, blue).
  colour(block2, white).

initially
  over(A, Z) for some Z.
  lies(B, Z) for some Z.

sees
  A sees covered(Z) if over(A, Z).
