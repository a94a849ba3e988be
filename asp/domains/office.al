% The robot-assistant domain at the coarse resolution: four rooms in a row, two books, a library
% that can be locked, and a robot that carries one book at a time.

sorts
  secure_room = {library}.
  room        = {kitchen, office1, office2} + secure_room.
  robot       = {rob1}.
  book        = {book1, book2}.
  object      = book.
  thing       = object + robot.

statics
  next_to(room, room).

fluents
  inertial loc(thing, room).
  inertial in_hand(robot, object).
  inertial locked(secure_room).

actions
  agent     move(robot, room).
  agent     pickup(robot, object).
  agent     put_down(robot, object).
  agent     unlock(robot, secure_room).
  exogenous exo_move(object, room).
  exogenous exo_lock(secure_room).

laws
  % Causal laws.
  move(R, L)     causes loc(R, L).
  pickup(R, O)   causes in_hand(R, O).
  put_down(R, O) causes -in_hand(R, O).
  unlock(R, L)   causes -locked(L).
  exo_lock(L)    causes locked(L).
  exo_move(O, L) causes loc(O, L).

  % State constraints.
  next_to(L1, L2) if next_to(L2, L1).
  -loc(T, L2)     if loc(T, L1), L1 != L2.              % one place at a time
  loc(O, L)       if loc(R, L), in_hand(R, O).          % what is held goes along
  -in_hand(R, O1) if in_hand(R, O2), O1 != O2.          % one object in the hand

  % Executability conditions of the robot's actions.
  impossible move(R, L)     if loc(R, L).
  impossible move(R, L2)    if loc(R, L1), -next_to(L1, L2).
  impossible move(R, L2)    if loc(R, L1), locked(L1).
  impossible move(R, L)     if locked(L).
  impossible unlock(R, L)   if -locked(L).
  impossible unlock(R, L1)  if loc(R, L2), -next_to(L2, L1), L2 != L1.
  impossible put_down(R, O) if -in_hand(R, O).
  impossible pickup(R, O1)  if in_hand(R, O2).
  impossible pickup(R, O)   if loc(R, L1), loc(O, L2), L1 != L2.

  % Executability conditions of the exogenous actions.
  impossible exo_move(O, L)  if loc(O, L).
  impossible exo_move(O, L)  if locked(L).
  impossible exo_move(O, L2) if loc(O, L1), locked(L1).
  impossible exo_move(O, L)  if in_hand(R, O).
  impossible exo_lock(L)     if locked(L).

facts
  next_to(office1, office2).
  next_to(office2, kitchen).
  next_to(kitchen, library).

initially
  loc(T, L) for some L.

% What the robot sees: where it is, what it holds, what is in its room and what is not, and the
% lock of a secure room from inside it and from the rooms next to it.
sees
  R sees loc(R, L)    if robot(R).
  R sees in_hand(R, O).
  R sees loc(O, L)    if robot(R), loc(R, L).
  R sees locked(L)    if robot(R), loc(R, L).
  R sees locked(L1)   if robot(R), loc(R, L2), next_to(L1, L2).

% What the outcome of an action shows to a robot that looks at nothing else.
shows
  move(R, L1)    shows loc(R, L2).
  move(R, L)     shows locked(L)     if -loc(R, L).
  move(R, L1)    shows locked(L2)    if -loc(R, L1), loc(R, L2).
  unlock(R, L)   shows locked(L).
  pickup(R, O)   shows in_hand(R, O).
  pickup(R, O)   shows loc(O, L)     if loc(R, L).
  put_down(R, O) shows in_hand(R, O).
  put_down(R, O) shows loc(O, L)     if loc(R, L).

% Execution units.
costs
  move(R, L)     costs 15.
  pickup(R, O)   costs 5.
  put_down(R, O) costs 5.
  unlock(R, L)   costs 5.

% When the exogenous action of a scenario fires: together with an action of the robot; it is drawn
% at random where `drawing` says so, else the first possible one is taken. A draw that comes to
% nothing is repeated at the next action. So did the simulator of the original experiments.
scenarios
  % 1, planning: the robot is alone.
  1: nothing.

  % 2, unexpected success: the other book is brought where it was to go.
  2: exo_move(B, library) upon put_down(R, O) if -locked(library), -loc(B, library).

  % 3: a book leaves the room in which the robot would have found it.
  3: exo_move(B, L2) upon move(R, L)
       drawing B with -in_hand(R, B)         then L2 with -loc(B, L2)
       if loc(B, L), L != library.
  3: exo_move(B, L2) upon pickup(R, O)
       drawing B with -in_hand(R, B), B != O then L2 with -loc(B, L2)
       if loc(R, L), loc(B, L), L != library.
  3: exo_move(B, L2) upon put_down(R, O)
       drawing B with -in_hand(R, B)         then L2 with -loc(B, L2)
       if loc(R, L), loc(B, L), L != library.

  % 4: a book turns up in the room in which the robot will be.
  4: exo_move(B, L) upon move(R, L)
       drawing B with -in_hand(R, B)         if -loc(B, L), L != library.
  4: exo_move(B, L) upon pickup(R, O)
       drawing B with -in_hand(R, B)         if loc(R, L), -loc(B, L), L != library.
  4: exo_move(B, L) upon put_down(R, O)
       drawing B with -in_hand(R, B)         if loc(R, L), -loc(B, L), L != library.

  % 5, failure to achieve the goal: a delivered book is taken away at the end of the plan.
  5: exo_move(B, kitchen) upon any
       if loc(B, library), loc(O, library), in_hand(R, O), B != O, -locked(library).

  % 6, failure to execute: the library is locked while the robot is on its way.
  6: exo_lock(library) upon any if -locked(library).

  % Any of these at any time. A book that the robot holds, or is picking up, passes the draw on to
  % the other one; the new room may be an impossible one.
  random: exo_lock(L)    upon any drawing L probability 0.92.
  random: exo_move(B, L) upon any
    drawing B with -in_hand(R, B), -pickup(R, B) then L with -loc(B, L) probability 0.92.

  % The same, but a book that cannot be moved is drawn, too, and of the rooms only the possible ones.
  random-possible: exo_lock(L)    upon any drawing L probability 0.92.
  random-possible: exo_move(B, L) upon any drawing B probability 0.92.
