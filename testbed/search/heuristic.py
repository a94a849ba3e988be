"""Potential heuristics: a sum of numbers, one for the value of each variable.

F. Pommerening, M. Helmert, G. Röger and J. Seipp, From non-negative to general operator cost
partitioning (2015). A linear program finds the numbers for which the sum is largest in one state,
where no change lowers it by more than its action costs, and where no state of the goal has more
than 0: then it is nowhere more than what it costs to achieve the goal. The changes are all that
the laws can do in any state, indirect effects and those under conditions like others: the answer
sets of a program of one step, which is made of the ground laws that the world is compiled from,
and of no other program.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, cached_property
from math import ceil, prod
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy  # type: ignore[import-untyped]  # its parts load when they are used
from clingo import Control, Symbol

from asp.language import Description, Literal
from asp.solving import BudgetError, Limits, answer_sets, deciding, fact, ground, is_satisfiable
from testbed.world import bits

Heuristic = Callable[[int], int]
"""A lower bound on what it costs to get from a state to the goal."""

LARGEST = 100_000.0
"""Bounds the numbers: where the goal is out of reach there would be no largest ones."""
LONGEST = 100_000
"""Actions of a plan; what the solver's tolerance adds up to along so many is taken off."""
ROUNDING = 1e-6
PROGRAM = Path(__file__).with_name("changes.lp")
MOST_CHANGES = 5_000
MOST_CONFLICTS = 100_000
Effect = tuple[int, int, int]
"""A variable, and its values before and after."""


def blind(_: int) -> int:
    """The heuristic of which nothing is known."""
    return 0


class Potentials:
    """The heuristics of a description, whose changes are enumerated at once."""

    def __init__(self, description: Description) -> None:
        self._fluents = {fluent: 1 << i for i, fluent in enumerate(description.fluents)}
        self._variables = variables_of(description)
        self._changes = changes(description, self._variables)

    def heuristic(self, state: int, goal: Iterable[Literal], costs: Mapping[str, int]) -> Heuristic:
        """One that is as large as possible in `state`, for it and what can be reached from it.

        It is admissible and consistent; `blind` where the changes are too many. What has no cost
        costs 0, and no cost is negative.
        """
        numbers = self._numbers(state, tuple(goal), costs)
        if numbers is None:
            return blind
        potentials, excess = numbers
        tables: dict[int, dict[int, float]] = {variable: {} for variable in self._variables}
        for (variable, value), potential in potentials.items():
            tables[variable][value] = potential
        looked_up = tuple(tables.items())

        def heuristic(state: int) -> int:
            # A value that no change has is that of all states from here on.
            exact = sum(table.get(state & variable, 0.0) for variable, table in looked_up)
            return max(0, ceil(exact - excess))

        return heuristic

    @cached_property
    def _lowering(self) -> tuple[list[tuple[int, int]], "scipy.sparse.csr_array"]:
        """The columns of the linear program, and by how much each change lowers the sum.

        There is a column per value of a variable that changes, and a row per change.
        """
        found = () if self._changes is None else self._changes.found
        entries = [
            (sign, row, (variable, value))
            for row, (_, effects) in enumerate(found)
            for variable, before, after in effects
            for value, sign in ((before, 1.0), (after, -1.0))
        ]
        signs, rows, places = zip(*entries, strict=True) if entries else ((), (), ())
        number = {column: n for n, column in enumerate(dict.fromkeys(places))}
        columns = [number[column] for column in places]
        shape = len(found), len(number)
        return [*number], scipy.sparse.coo_array((signs, (rows, columns)), shape).tocsr()

    def _numbers(
        self, state: int, goal: Sequence[Literal], costs: Mapping[str, int]
    ) -> tuple[dict[tuple[int, int], float], float] | None:
        """The potentials of the columns and what to take off their sum; None: there are none."""
        changes, (columns, lowering) = self._changes, self._lowering
        if not changes or not columns or not all(state & own for own in changes.covered):
            return None
        most_lowered = np.array([costs.get(action, 0) for action, _ in changes.found], dtype=float)
        at_start = [state & variable == value for variable, value in columns]
        most = [0.0 if self._agree(goal, *column) else LARGEST for column in columns]
        solved = scipy.optimize.linprog(
            -np.array(at_start, dtype=float),
            A_ub=lowering,
            b_ub=most_lowered,
            bounds=[(-LARGEST, greatest) for greatest in most],
            method="highs-ds",
        )
        if not solved.success:
            return None
        excess = max(0.0, float(np.max(lowering @ solved.x - most_lowered)))
        potentials = dict(zip(columns, solved.x.tolist(), strict=True))
        return potentials, ROUNDING + LONGEST * excess

    def _agree(self, goal: Iterable[Literal], variable: int, value: int) -> bool:
        """Whether the variable can have this value where the goal holds."""
        wanted = ((self._fluents[own.atom], own.is_positive) for own in map(Literal.parse, goal))
        return all(bool(value & fluent) == truth for fluent, truth in wanted if variable & fluent)


def variables_of(description: Description) -> tuple[int, ...]:
    """The variables, each a mask of fluents, whose value in a state masks those that are true.

    There is one per constant, of the fluents that mention it, and one per fluent without any.
    A variable that could have more values than two functions of its fluents is left out.
    """
    about: dict[str, list[int]] = defaultdict(list)
    for number, fluent in enumerate(description.fluents):
        for constant in dict.fromkeys(fluent.arguments) or (fluent,):
            about[constant].append(number)
    exclusive = _exclusive(description)
    return tuple(
        sum(1 << number for number in fluents)
        for fluents in about.values()
        if _most_values(fluents, exclusive) <= max(2, len(fluents) ** 2)
    )


def _exclusive(description: Description) -> frozenset[tuple[int, int]]:
    """Pairs of fluents of which a constraint allows at most one."""
    number = {fluent: i for i, fluent in enumerate(description.fluents)}
    pairs = [
        (number[law.body[0]], number[law.head.atom])
        for law in description.constraints
        if len(law.body) == 1 and law.body[0].is_positive and not law.head.is_positive
    ]
    return frozenset((*pairs, *(pair[::-1] for pair in pairs)))


def _most_values(fluents: Iterable[int], exclusive: frozenset[tuple[int, int]]) -> int:
    """How many values at most: of fluents that exclude each other one is true, or none."""
    groups: list[list[int]] = []
    for fluent in fluents:
        fitting = (g for g in groups if exclusive.issuperset((fluent, other) for other in g))
        group = next(fitting, None)
        if group is None:
            groups.append([fluent])
        else:
            group.append(fluent)
    return prod(len(group) + 1 for group in groups)


class Changes(NamedTuple):
    """Each action of the agents with what it does to all variables at once, in every way.

    These are the changes of states in which each mask of `covered` has a true fluent; no action
    leads out of them.
    """

    covered: tuple[int, ...]
    found: tuple[tuple[str, tuple[Effect, ...]], ...]


def changes(description: Description, variables: Sequence[int]) -> Changes | None:
    """All changes of the variables; None where there are too many of them, or they take too long.

    They are the answer sets of a program of one step, made of the ground laws that the world is
    compiled from and of no other program. Where no action leads out of the states that have all of
    `initially`, only these are looked at.
    """
    mask = {fluent: 1 << number for number, fluent in enumerate(description.fluents)}
    covered = tuple(sum(mask[fluent] for fluent in some) for some in description.initially)
    control, within, leaves = _program(description, variables), fact("within"), fact("leaves")
    try:
        with deciding(Limits(conflicts=MOST_CONFLICTS)):
            if is_satisfiable(control, [(within, True), (leaves, True)]):
                covered = ()
            found, more = answer_sets(control, [(within, bool(covered))], MOST_CHANGES)
    except BudgetError:
        return None
    shown = (_change(symbols, description, variables) for symbols in found)
    return None if more else Changes(covered, tuple(sorted(shown)))


def _program(description: Description, variables: Sequence[int]) -> Control:
    """`changes.lp` with the laws, which are many: they are added as they are, and not as text."""
    number = {fluent: n for n, fluent in enumerate(description.fluents)}
    actions = {action: n for n, action in enumerate(description.agent_actions)}
    control = ground([PROGRAM.read_text("utf-8")], {}, [])
    with control.backend() as backend:
        atom = cache(lambda name, *arguments: backend.add_atom(fact(name, *arguments)))

        def held(literals: Iterable[Literal], time: int) -> list[int]:
            return [atom("holds", number[x.atom], int(x.is_positive), time) for x in literals]

        given: list[tuple[str | int, ...]] = [
            *(("inertial", number[fluent]) for fluent in description.inertial),
            *(("defined", number[fluent]) for fluent in description.defined),
            *(("action", n) for n in actions.values()),
            *(("initially", i, number[x]) for i, s in enumerate(description.initially) for x in s),
            *(("variable", i, n) for i, x in enumerate(variables) for n in bits(x)),
        ]
        for own in given:
            backend.add_rule([atom(*own)])
        for law in description.constraints:
            for time in range(2):
                backend.add_rule(held([law.head], time), held(law.body, time))
        for effect in description.causal:
            if effect.action in actions:
                occurs = atom("occurs", actions[effect.action])
                backend.add_rule(held([effect.head], 1), [occurs, *held(effect.body, 0)])
        for condition in description.executability:
            if len(condition.actions) == 1 and condition.actions[0] in actions:
                occurs = atom("occurs", actions[condition.actions[0]])
                backend.add_rule([], [occurs, *held(condition.body, 0)])
    control.ground([("frame", [])])
    return control


def _change(
    symbols: Iterable[Symbol], description: Description, variables: Sequence[int]
) -> tuple[str, tuple[Effect, ...]]:
    """What an answer set shows: the action, and the values of what changes."""
    action, values = "", defaultdict[int, list[int]](lambda: [0, 0])
    for symbol in symbols:
        first, *rest = (argument.number for argument in symbol.arguments)
        if symbol.name == "occurs":
            action = description.agent_actions[first]
            continue
        own = values[variables[first]]
        if rest:
            time, number = rest
            own[time] |= 1 << number
    return action, tuple((own, before, after) for own, (before, after) in sorted(values.items()))
