% The office whose books have their places: most stand in the library, cookbooks in the kitchen. A
% robot that starts knowing only what it sees looks for them there first.

sorts
  secure_room = {library}.
  room        = {kitchen, office1, office2} + secure_room.
  robot       = {rob1}.
  cookbook    = {cookbook1}.
  book        = {book1, book2} + cookbook.
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

% Where things are at the start, usually. What the robot holds is where the robot is.
defaults
  shelved:  loc(B, library) if book(B).
  lent:     loc(B, office1) if book(B), -loc(B, library).
  cooking:  loc(B, kitchen) if cookbook(B).
  open:     -locked(L).
  exception shelved if cookbook(B).
  exception shelved if in_hand(R, B).
  exception lent    if cookbook(B).
  exception lent    if in_hand(R, B).
  exception cooking if in_hand(R, B).

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

% What others do while the robot is at work, one event at most.
scenarios
  % 1: nothing exogenous happens.
  1: nothing.

  % borrowed: somebody takes a book out of its room, but not to the library.
  borrowed: exo_move(B, L) upon any drawing B if L != library probability 0.2.

  % returned: somebody brings a book to the library.
  returned: exo_move(B, library) upon any drawing B probability 0.2.

  % random: the library is locked or a book is brought elsewhere, at any time.
  random: exo_lock(L)    upon any drawing L probability 0.92.
  random: exo_move(B, L) upon any drawing B probability 0.92.
