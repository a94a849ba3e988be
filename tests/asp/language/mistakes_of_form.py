"""Mistakes of grammar and of form: what is wrong, the text, its place, words of the message."""

SYNTAX = {
    "a character of no word": ("lit & warm.", "16:5", "unexpected character '&'"),
    "a word where an operator is due": ("lit warm.", "16:5", "expected '(' or 'causes' or 'if'"),
    "two literals without a comma": ("lit if warm warm.", "16:13", "expected '!=' or '(' or ','"),
    "arguments without a comma": (
        "loc(T L) if lit.",
        "16:7",
        "unexpected 'L'; expected ')' or ','",
    ),
    "a body that breaks off": ("lit if warm, .", "16:14", "expected '-' or a name"),
    "a variable as a fluent": ("Lit if warm.", "16:1", "unexpected 'Lit'"),
    "a name like a variable of a program": ("_Lit if warm.", "16:1", "unexpected character '_'"),
    "a text that ends inside a body": ("lit if", "16:7", "the text ends inside a statement"),
    "a text that ends without a full stop": ("lit if warm\n\n", "16:12", "ends inside a statement"),
    "an empty sort": ("sorts\n  a = {}.", "17:8", "unexpected '}'; expected a name or a number"),
    "a range to a name": ("sorts\n  a = {1..b}.", "17:11", "unexpected 'b'; expected a number"),
    "a number beyond those of programs": (
        "sorts\n  a = {9999999999}.",
        "17:8",
        "unexpected character '9'",
    ),
    "a fluent without its kind": ("fluents\n  dim.", "17:3", "'defined' or 'inertial'"),
    "an action declared as a fluent": (
        "actions\n  inertial dim.",
        "17:3",
        "'agent' or 'exogenous'",
    ),
    "a cost that is a variable": ("costs\n  carry(T, L) costs C.", "17:21", "expected a number"),
    "a range with one dot": ("sorts\n  a = {1.2}.", "17:9", "expected ',' or '..' or '}'"),
    "a robot that sees without the word": ("sees\n  r lit.", "17:5", "expected 'sees'"),
    "an outcome without its word": ("shows\n  go(a) lit.", "17:9", "expected 'shows'"),
    "a cost without its word": ("costs\n  go(a) 5.", "17:9", "expected 'costs'"),
    "a misspelt section word": (
        "lit if warm.\ncost\n  go costs 5.",
        "17:1",
        "unknown section 'cost'; did you mean 'costs'?",
    ),
    "a misspelt section word before a number": (
        "lit if warm.\n  senarios   % 1 to 6\n  1: blow upon any.",
        "17:3",
        "unknown section 'senarios'; did you mean 'scenarios'?",
    ),
    "a misspelt section word behind another": ("facts\nlwas\n  lit.", "17:1", "'laws'?"),
    "a misspelt section word at the end": ("law\n", "16:1", "did you mean 'laws'?"),
    "a section word with a statement behind it": ("facts next_to(hall, attic).", "16:7", "alone"),
    "a section word behind a statement": ("lit if warm. facts", "16:14", "'facts' stands alone"),
}

FORMS = {
    "an agent's action in a body": (
        "lit if carry(T, L).",
        "16:8",
        "'carry' is an agent action; this place needs a fluent, a static or a sort in a body",
    ),
    "an exogenous action in a body": (
        "lit if warm, blow.",
        "16:14",
        "'blow' is an exogenous action",
    ),
    "an action in the body of a causal law": ("blow causes lit if blow.", "16:20", "in a body"),
    "an action in an executability condition": ("impossible blow if blow.", "16:20", "in a body"),
    "an action as a head": ("blow if lit.", "16:1", "needs a fluent or a static as the head"),
    "a sort as a head": ("room(hall) if lit.", "16:1", "'room' is a sort"),
    "a fluent that causes": ("lit causes warm.", "16:1", "needs an action before 'causes'"),
    "a defined fluent as an effect": (
        "carry(T, L) causes seen(T).",
        "16:20",
        "'seen' is a defined fluent; this place needs an inertial fluent as the effect",
    ),
    "a static as an effect": ("blow causes far(hall, attic).", "16:13", "'far' is a static"),
    "an action as an effect": (
        "blow causes blow.",
        "16:13",
        "needs an inertial fluent as the effect",
    ),
    "an impossible fluent": (
        "impossible blow, lit.",
        "16:18",
        "needs an action after 'impossible'",
    ),
    "a negated sort": (
        "lit if loc(T, L), -room(L).",
        "16:20",
        "a sort in a body cannot be negated",
    ),
    "a defined fluent negated in a head": (
        "-seen(T) if lit.",
        "16:1",
        "'seen' is defined: it is false unless derived",
    ),
    "a static negated in a head": (
        "-far(L, L).",
        "16:1",
        "false unless derived; drop the negation",
    ),
    "a static that depends on a fluent": (
        "far(L, L) if warm.",
        "16:14",
        "the static 'far' cannot depend on the fluent 'warm'",
    ),
    "a negated fact": ("facts\n  -far(hall, hall).", "17:3", "what is not stated is false"),
    "a fluent as a fact": ("facts\n  loc(book, hall).", "17:3", "needs a static as a fact"),
    "an action that is seen": ("sees\n  hall sees blow.", "17:13", "needs a fluent after 'sees'"),
    "an outcome of an exogenous action": (
        "shows\n  blow shows lit.",
        "17:3",
        "needs an agent action",
    ),
    "an outcome that shows an action": (
        "shows\n  carry(T, L) shows blow.",
        "17:21",
        "needs a fluent after 'shows'",
    ),
    "the cost of an exogenous action": (
        "costs\n  blow costs 3.",
        "17:3",
        "an agent action before 'costs'",
    ),
    "an action at first": (
        "initially\n  carry(T, L) for some L.",
        "17:3",
        "a fluent before 'for some'",
    ),
    "an agent's action as an event": (
        "scenarios\n  2: carry(T, L) upon any.",
        "17:6",
        "needs an exogenous action as the event",
    ),
    "an event upon an event": (
        "scenarios\n  2: blow upon blow.",
        "17:16",
        "an agent action after 'upon'",
    ),
    "a default without a name": ("defaults\n  lit if warm.", "17:7", "expected ':'"),
    "a default about a defined fluent": (
        "defaults\n  d: seen(T).",
        "17:6",
        "'seen' is a defined fluent; this place needs an inertial fluent as the conclusion",
    ),
    "a default about an action": (
        "defaults\n  d: blow.",
        "17:6",
        "needs an inertial fluent as the conclusion",
    ),
    "an action in the body of an exception": (
        "defaults\n  d: lit.\n  exception d if blow.",
        "18:18",
        "'blow' is an exogenous action",
    ),
    "an exception without a condition": (
        "defaults\n  d: lit.\n  exception d.",
        "18:14",
        "expected 'if'",
    ),
    "two defaults of one name": (
        "defaults\n  d: lit.\n  d: warm.",
        "18:3",
        "two defaults have the name 'd'; first in line 17",
    ),
    "a quiet scenario in which something happens": (
        "scenarios\n  2: blow upon any.\n  3: nothing.\n  2: nothing.",
        "19:3",
        "in scenario '2' something happens; see line 17",
    ),
    "an action in the body of a law": (
        "laws\n  lit if carry(T, L).",
        "17:10",
        "'carry' is an agent action",
    ),
    "an event as a condition of an event": (
        "scenarios\n  2: blow upon any if blow.",
        "17:23",
        "this place needs a fluent, a static, a sort or an agent action in a body",
    ),
    "a variable that is drawn twice": (
        "scenarios\n  2: blow upon any drawing T with loc(T, L) then L then T.",
        "17:57",
        "variable T is drawn already",
    ),
    "a draw after nothing": ("scenarios\n  2: blow upon any then T.", "17:20", "unexpected 'then'"),
    "a draw of a constant": (
        "scenarios\n  2: blow upon any drawing T with loc(T, hall) then hall.",
        "17:53",
        "unexpected 'hall'; expected a variable",
    ),
    "a probability above 1": (
        "scenarios\n  2: blow upon any probability 2.",
        "17:3",
        "between 0 and 1",
    ),
}

CYCLES = {
    "a fluent through its own negation": (
        "lit if -lit.",
        "16:1",
        "'lit' is defined through its own negation by way of '-lit'",
    ),
    "a fluent through another one": (
        "lit if -warm.\nwarm if -lit.",
        "16:1",
        "'lit' is defined through its own negation by way of '-warm'",
    ),
    "through another one that is not negated": (
        "lit if warm.\nwarm if -lit.",
        "17:1",
        "by way of '-lit'",
    ),
    "through a defined fluent": (
        "lit if -seen(book).\nseen(T) if lit.",
        "16:1",
        "by way of '-seen(book)'",
    ),
    "some instance of a fluent": (
        "loc(T, hall) if -loc(T, attic).\nloc(T, L) if loc(T, hall), next_to(L, hall).\n"
        "facts\nnext_to(attic, hall).",
        "16:1",
        "'loc(book,hall)' is defined through its own negation by way of '-loc(book,attic)'",
    ),
    "a defined fluent by way of a negated inertial one": (
        "seen(T) if -lit.\n-lit if -seen(T).",
        "16:1",
        "'seen(book)' is defined through its own negation by way of '-lit'",
    ),
    "a static": ("far(L, L) if -far(L, L).", "16:1", "'far' is defined through its own negation"),
    "a static through another one": (
        "far(L, L) if -next_to(L, L).\nnext_to(L, L) if -far(L, L).",
        "16:1",
        "'far' is defined through its own negation",
    ),
}
