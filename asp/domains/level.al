% An office of a complexity level: rooms in a row, objects, and a robot that carries one of them at
% a time. The laws are those of the office without a room that can be locked. This one is level L2;
% texts of all sizes are made of it.

sorts
  room   = {room1, room2, room3}.
  robot  = {rob1}.
  object = {object1, object2}.
  thing  = object + robot.

statics
  next_to(room, room).

fluents
  inertial loc(thing, room).
  inertial in_hand(robot, object).

actions
  agent     move(robot, room).
  agent     pickup(robot, object).
  agent     put_down(robot, object).
  exogenous exo_move(object, room).

laws
  % Causal laws.
  move(R, L)     causes loc(R, L).
  pickup(R, O)   causes in_hand(R, O).
  put_down(R, O) causes -in_hand(R, O).
  exo_move(O, L) causes loc(O, L).

  % State constraints.
  next_to(L1, L2) if next_to(L2, L1).
  -loc(T, L2)     if loc(T, L1), L1 != L2.              % one place at a time
  loc(O, L)       if loc(R, L), in_hand(R, O).          % what is held goes along
  -in_hand(R, O1) if in_hand(R, O2), O1 != O2.          % one object in the hand

  % Executability conditions of the robot's actions.
  impossible move(R, L)     if loc(R, L).
  impossible move(R, L2)    if loc(R, L1), -next_to(L1, L2).
  impossible put_down(R, O) if -in_hand(R, O).
  impossible pickup(R, O1)  if in_hand(R, O2).
  impossible pickup(R, O)   if loc(R, L1), loc(O, L2), L1 != L2.

  % Executability conditions of the exogenous action.
  impossible exo_move(O, L) if loc(O, L).
  impossible exo_move(O, L) if in_hand(R, O).

facts
  next_to(room1, room2).
  next_to(room2, room3).

initially
  loc(T, L) for some L.

% What the robot sees: where it is, what it holds, what is in its room and what is not.
sees
  R sees loc(R, L)    if robot(R).
  R sees in_hand(R, O).
  R sees loc(O, L)    if robot(R), loc(R, L).

% What the outcome of an action shows to a robot that looks at nothing else.
shows
  move(R, L1)    shows loc(R, L2).
  pickup(R, O)   shows in_hand(R, O).
  pickup(R, O)   shows loc(O, L)     if loc(R, L).
  put_down(R, O) shows in_hand(R, O).
  put_down(R, O) shows loc(O, L)     if loc(R, L).

% Execution units.
costs
  move(R, L)     costs 15.
  pickup(R, O)   costs 5.
  put_down(R, O) costs 5.
