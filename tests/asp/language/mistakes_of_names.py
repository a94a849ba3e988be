"""Mistakes in names and arguments: what is wrong, the text, its place, words of the message."""

NAMES = {
    "an unknown sort in a sort": (
        "sorts\n  place = rom + {yard}.",
        "17:11",
        "unknown sort 'rom'; did you mean 'room'?",
    ),
    "a sort used before its line": (
        "fluents\n  inertial old(year).\nsorts\n  year = {1..3}.",
        "17:16",
        "unknown sort 'year'; known: room, thing",
    ),
    "an unknown sort of a static": ("statics\n  big(thng).", "17:7", "did you mean 'thing'?"),
    "an unknown sort of an action": ("actions\n  agent go(rom).", "17:12", "did you mean 'room'?"),
    "an unknown fluent in a body": (
        "lit if worm.",
        "16:8",
        "unknown fluent 'worm'; did you mean 'warm'?",
    ),
    "an unknown fluent in a head": (
        "lid if warm.",
        "16:1",
        "unknown fluent 'lid'; did you mean 'lit'?",
    ),
    "an unknown effect": (
        "blow causes litt.",
        "16:13",
        "unknown fluent 'litt'; did you mean 'lit'?",
    ),
    "an unknown action": (
        "cary(T, L) causes loc(T, L).",
        "16:1",
        "unknown action 'cary'; did you mean 'carry'?",
    ),
    "an unknown impossible action": ("impossible blov.", "16:12", "did you mean 'blow'?"),
    "an unknown static": (
        "facts\n  nxt_to(hall, attic).",
        "17:3",
        "unknown static 'nxt_to'; did you mean 'next_to'?",
    ),
    "a name without likeness": (
        "lit if xyzzy.",
        "16:8",
        "known: far, lit, loc, next_to, seen, warm",
    ),
    "an unknown constant in a comparison": (
        "lit if loc(T, L), L != hal.",
        "16:24",
        "unknown constant 'hal'; did you mean 'hall'?",
    ),
    "an unknown robot": ("sees\n  lamb sees lit.", "17:3", "'lamb'; did you mean 'lamp'?"),
    "a fluent's name used again": (
        "fluents\n  inertial lit.",
        "17:3",
        "the name 'lit' is used twice; first in line 9",
    ),
    "a fluent's name for other arguments": ("fluents\n  inertial loc(room).", "17:3", "line 8"),
    "a sort's name for an action": ("actions\n  agent room.", "17:3", "first in line 2"),
    "a sort defined again": ("sorts\n  room = {yard}.", "17:3", "first in line 2"),
    "a constant twice in one sort": (
        "sorts\n  pet = {cat, cat}.",
        "17:15",
        "the name 'cat' is used twice in one sort",
    ),
    "an empty range": ("sorts\n  year = {3..1}.", "17:3", "the range of sort 'year' is empty"),
    "a constant of the programs": (
        "sorts\n  side = {n, s}.",
        "17:11",
        "the name 'n' means something else",
    ),
    "a sort of the programs": ("sorts\n  step = {one}.", "17:3", "take another"),
    "an action of the mind": ("actions\n  agent start(room).", "17:3", "the name 'start' means"),
}

ARGUMENTS = {
    "too few arguments of an effect": (
        "carry(T, L) causes loc(T).",
        "16:20",
        "'loc' takes 2 argument(s), not 1: loc(thing, room)",
    ),
    "too few arguments of an action": (
        "carry(T) causes lit.",
        "16:1",
        "'carry' takes 2 argument(s), not 1: carry(thing, room)",
    ),
    "arguments of what has none": (
        "lit if warm(hall).",
        "16:8",
        "'warm' takes 0 argument(s), not 1: warm",
    ),
    "too many arguments of a static": (
        "facts\n  next_to(hall, attic, hall).",
        "17:3",
        "'next_to' takes 2 argument(s), not 3: next_to(room, room)",
    ),
    "two arguments of a sort": (
        "lit if room(hall, attic).",
        "16:8",
        "'room' takes 1 argument(s), not 2",
    ),
    "a constant of another sort": (
        "lit if loc(hall, attic).",
        "16:12",
        "'hall' is not of sort 'thing'; known: book, lamp",
    ),
    "a misspelt constant": (
        "lit if loc(boook, hall).",
        "16:12",
        "'boook' is not of sort 'thing'; did you mean 'book'?",
    ),
    "a variable of two sorts": (
        "lit if loc(X, L), next_to(L, X).",
        "16:1",
        "no constant fits all the places of variable X",
    ),
    "a variable of a comparison alone": (
        "lit if next_to(L1, L3), L1 != L2.",
        "16:31",
        "variable L2 is bound by nothing",
    ),
    "a variable that is said to be something": (
        "lit if warm, X = hall.",
        "16:14",
        "X is bound by nothing",
    ),
    "a robot that is anyone": ("sees\n  R sees lit.", "17:3", "variable R is bound by nothing"),
    "an exception to no default": (
        "defaults\n  dark: -lit.\n  exception drak if warm.",
        "18:3",
        "unknown default 'drak'; did you mean 'dark'?",
    ),
    "an exception for what does not occur": (
        "defaults\n  d: loc(T, hall).\n  exception d if T != X.",
        "18:23",
        "variable X is bound by nothing",
    ),
    "an exception for another sort": (
        "defaults\n  d: loc(T, hall).\n  exception d if room(T).",
        "18:3",
        "no constant fits all the places of variable T",
    ),
    "a default that a program would take for a number": (
        "defaults\n  n: lit.",
        "17:3",
        "the name 'n' means something else in programs",
    ),
    "some of what does not occur": (
        "initially\n  loc(T, L) for some X.",
        "17:22",
        "variable X is bound by nothing",
    ),
    "drawing what does not occur": (
        "scenarios\n  2: blow upon any drawing T.",
        "17:28",
        "variable T is bound by nothing",
    ),
}
