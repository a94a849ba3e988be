% The refinement of two rooms of two cells and an object of two parts, written by hand.
sorts
  room       = {room1, room2}.
  cell       = {room1_1, room1_2, room2_1, room2_2}.
  robot      = {rob1}.
  object     = {object1}.
  part       = {object1_1, object1_2}.
  thing      = object + robot.
  fine_thing = part + robot.
  fine       = cell + part + robot.
  coarse     = room + object + robot.
statics
  next_to(room, room).
  fine_next_to(cell, cell).
  component(fine, coarse).
fluents
  inertial fine_loc(fine_thing, cell).
  inertial fine_in_hand(robot, part).
  defined  loc(thing, room).
  defined  in_hand(robot, object).
actions
  agent     fine_move(robot, cell).
  agent     fine_pickup(robot, part).
  agent     fine_put_down(robot, part).
  exogenous fine_exo_move(part, cell).
laws
  fine_move(R, C)     causes fine_loc(R, C).
  fine_pickup(R, P)   causes fine_in_hand(R, P).
  fine_put_down(R, P) causes -fine_in_hand(R, P).
  fine_exo_move(P, C) causes fine_loc(P, C).
  next_to(L1, L2) if next_to(L2, L1).
  fine_next_to(C1, C2) if fine_next_to(C2, C1).
  -fine_loc(T, C2)     if fine_loc(T, C1), C1 != C2.
  fine_loc(P, C)       if fine_loc(R, C), fine_in_hand(R, P), robot(R), part(P).
  -fine_in_hand(R, P1) if fine_in_hand(R, P2), P1 != P2.
  fine_loc(P1, C)      if fine_loc(P2, C), component(P1, O), component(P2, O), part(P1), part(P2).
  loc(T, L)    if component(P, T), component(C, L), fine_loc(P, C).
  in_hand(R, O) if component(P, O), fine_in_hand(R, P).
  impossible fine_move(R, C)     if fine_loc(R, C).
  impossible fine_move(R, C2)    if fine_loc(R, C1), -fine_next_to(C1, C2).
  impossible fine_put_down(R, P) if -fine_in_hand(R, P).
  impossible fine_pickup(R, P1)  if fine_in_hand(R, P2).
  impossible fine_pickup(R, P)   if fine_loc(R, C1), fine_loc(P, C2), C1 != C2.
  impossible fine_exo_move(P, C) if fine_loc(P, C).
  impossible fine_exo_move(P, C) if fine_in_hand(R, P1), component(P, O), component(P1, O).
facts
  next_to(room1, room2).
  fine_next_to(room1_1, room1_2).
  fine_next_to(room1_2, room2_1).
  fine_next_to(room2_1, room2_2).
  component(room1_1, room1).
  component(room1_2, room1).
  component(room2_1, room2).
  component(room2_2, room2).
  component(object1_1, object1).
  component(object1_2, object1).
  component(rob1, rob1).
initially
  fine_loc(T, C) for some C.
