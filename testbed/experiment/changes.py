"""What one action can change, whatever the state: the answer sets of a program of one step.

The program is made of the ground laws that the world is compiled from, and of no other program.
"""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from clingo import Control, Symbol

from asp.language import Description, Literal
from asp.solving import BudgetError, Limits, answer_sets, deciding, fact, ground, is_satisfiable
from testbed.world import bits

PROGRAM = Path(__file__).with_name("changes.lp")
MOST_CHANGES = 5_000
MOST_CONFLICTS = 100_000


Effect = tuple[int, int, int]
"""A variable, and its values before and after."""


@dataclass(frozen=True)
class Changes:
    """Each action of the agents with what it does to all variables at once, in every way.

    These are the changes of states in which each mask of `covered` has a true fluent; no action
    leads out of them.
    """

    covered: tuple[int, ...]
    found: tuple[tuple[str, tuple[Effect, ...]], ...]

    def cover(self, state: int) -> bool:
        """Whether they are all that can happen from the state on."""
        return all(state & some for some in self.covered)


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
