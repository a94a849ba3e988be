% The robot assistant of the paper's example of zooming: four rooms, books and a cup.
sorts
  place  = {office1, office2, kitchen, library}.
  robot  = {rob1}.
  book   = {tb1, tb2}.
  cup    = {cup1}.
  object = book + cup.
  thing  = object + robot.
statics
  next_to(place, place).
fluents
  inertial loc(thing, place).
  inertial in_hand(robot, object).
actions
  agent     move(robot, place).
  agent     pickup(robot, object).
  agent     put_down(robot, object).
  agent     wash(robot, cup).
  exogenous exo_move(object, place).
laws
  move(R, L)     causes loc(R, L).
  pickup(R, O)   causes in_hand(R, O).
  put_down(R, O) causes -in_hand(R, O).
  wash(R, C)     causes -in_hand(R, C).
  exo_move(O, L) causes loc(O, L).
  next_to(L1, L2) if next_to(L2, L1).
  -loc(T, L2)     if loc(T, L1), L1 != L2.
  loc(O, L)       if loc(R, L), in_hand(R, O).
  -in_hand(R, O1) if in_hand(R, O2), O1 != O2.
  impossible move(R, L)     if loc(R, L).
  impossible move(R, L2)    if loc(R, L1), -next_to(L1, L2).
  impossible put_down(R, O) if -in_hand(R, O).
  impossible wash(R, C)     if -in_hand(R, C).
  impossible pickup(R, O1)  if in_hand(R, O2).
  impossible pickup(R, O)   if loc(R, L1), loc(O, L2), L1 != L2.
  impossible exo_move(O, L) if loc(O, L).
  impossible exo_move(O, L) if in_hand(R, O).
facts
  next_to(office2, office1).
  next_to(office1, kitchen).
  next_to(kitchen, library).
initially
  loc(T, L) for some L.
