"""Plans of exactly so many steps for one problem alone, where a session would be too large.

The rules are those of `asp.reasoning.fine_planning.compact_session`, but start and goal are part of
the program, and functions are confined to the values that can lead to the goal
(`asp.reasoning.fine_planning.large.value_pruning`). So clingo grounds what is about states on the
way only, and not each step for all of the description. That pays from rooms of 64 cells on.

Constants that a plan has nothing to do with are not even instantiated. A constant is out of play if
nothing that names it can be true on the way, nor an action that names it occur. What a rule says of
such a constant is void where the rule's head names it, or a condition that has to be true;
variables that occur elsewhere only are *loose*, and constants that they may stand for stay in play.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import clingo
from clingo import Number

from asp.language import Action, Fluent, Function, Literal
from asp.reasoning.fine_planning.compact_session import MOST_LEVELS, CompactPart, parts, read
from asp.reasoning.fine_planning.large.relaxed_reachability import Reach
from asp.reasoning.fine_planning.large.value_pruning import Functions, Values, confined
from asp.solving import ground, literal_of, solving, theory
from asp.translation import ACTION, Part, Rule


@dataclass(frozen=True)
class Problem:
    """What is planned from and for: `candidates` by function, exactly one of each holds."""

    true: frozenset[Fluent]
    candidates: Mapping[Fluent, Sequence[Fluent]]
    goal: tuple[Literal, ...]


class ProblemPrograms:
    """Programs for single problems in a part of a description."""

    def __init__(
        self, part: CompactPart, functions: Mapping[str, Function], landmarks: bool
    ) -> None:
        """With `landmarks` functions are confined."""
        self._confines = landmarks
        self._rules = part.worded(Rule.confined)
        self._ranks = {action: rank for rank, action in enumerate(part.actions)}
        self._loose = loose(part.rules, part.sorts)
        self._known = Functions(part.relaxed, functions)
        self._facts = [(f"{fact}.", frozenset(fact.arguments)) for fact in part.relaxed.facts]

    def plan(self, problem: Problem, reach: Reach, length: int) -> tuple[Action, ...] | None:
        """The first plan of exactly so many steps, or None. Raises LimitError."""
        reach.through(length)
        steps = (
            confined(reach, self._known.number, length)
            if self._confines
            else [Values() for _ in range(length + 1)]
        )
        left = [dict(self._told(values)) for values in steps]
        playing = self._loose | in_play(reach, self._known, steps)
        static = (fact for fact, about in self._facts if about <= playing)
        program = "\n".join([self._rules, f"#program {Part.BASE}.", *static])
        given = (*_given(problem, left[0]), *_within(left))
        texts = [program, theory("incremental_fine_planning")]
        control = ground(texts, {"n": length}, given, ["problem"])
        first, *others = parts(length)
        control.ground([first, ("open", []), *others, ("goal", [Number(length)])])
        _prefer(control, self._ranks)
        with solving(control) as model:
            return None if model is None else read(model)

    def _told(self, values: Values) -> Iterator[tuple[str, Sequence[str]]]:
        """The functions confined at a step, with the fluents left."""
        for number, nodes in values.items():
            fluents = [self._known.text[node] for node in nodes]
            yield from ((term, fluents) for term in self._known.terms[number])


def loose(rules: Iterable[Rule], sorts: Mapping[str, Sequence[str]]) -> frozenset[str]:
    """The constants that rules name, or that a loose variable of a rule may stand for."""
    found: set[str] = set()
    for rule in rules:
        found |= rule.constants
        if rule.part in (Part.STATE, Part.STEP):
            found.update(*(sorts[sort] for sort in rule.loose))
    return frozenset(found)


def in_play(reach: Reach, known: Functions, steps: Sequence[Values]) -> frozenset[str]:
    """The constants of what may be true, or may occur, at some step, as functions are confined."""
    free = {
        number
        for number, terms in enumerate(known.terms)
        if any(number not in step for step in (steps[:-1] if ACTION in terms else steps))
    }
    left = {node for step in steps for nodes in step.values() for node in nodes}
    return frozenset(
        constant
        for node, level in reach.level.items()
        if level < len(steps) and node in known.text
        if node in left or known.number.get(node) in (None, *free)
        for constant in known.text[node].arguments
    )


def _given(problem: Problem, confined: Mapping[str, Sequence[str]]) -> Iterator[str]:
    yield from (f"certain({fluent})" for fluent in sorted(problem.true))
    for function, group in problem.candidates.items():
        yield f"group({function})"
        left = set(confined.get(function, group))
        yield from (f"candidate({function},{fluent})" for fluent in group if fluent in left)
    for literal in problem.goal:
        yield f"{'wanted' if literal.is_positive else 'unwanted'}({literal.atom})"


def _within(confined: Sequence[Mapping[str, Sequence[str]]]) -> Iterator[str]:
    for step, functions in enumerate(confined):
        for function, fluents in functions.items():
            yield f"confined({function},{step})"
            yield from (f"within({fluent},{step})" for fluent in fluents)


def _prefer(control: clingo.Control, actions: Mapping[Action, int]) -> None:
    """Earlier steps count before later ones, and actions in the order of declaration."""
    occurring = []
    for found in control.symbolic_atoms.by_signature("occurs", 2):
        action, step = found.symbol.arguments
        occurring.append((step.number, actions[literal_of(action)], found.literal))
    with control.backend() as backend:
        for level, (_, _, literal) in zip(
            range(MOST_LEVELS, 0, -1), sorted(occurring), strict=False
        ):
            backend.add_heuristic(literal, clingo.HeuristicType.True_, level, level, [])
