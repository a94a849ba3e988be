"""Plans of exactly so many steps for one problem alone, where a control to keep would be too large.

The rules are those of `asp.reasoning.fine_planning.horizon`, but start and goal are part of the
program, and functions are confined to the values that can lead to the goal
(`asp.reasoning.fine_planning.large.value_pruning`). So clingo grounds what is about states on the
way only, and not each step for all of the description.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import clingo
from clingo import Number

from asp.language import atom, is_positive
from asp.reasoning.fine_planning.horizon import MOST_LEVELS, parts, read
from asp.solving import ground, solving, theory


@dataclass(frozen=True)
class Problem:
    """What is planned from and for: `candidates` by function, exactly one of each holds."""

    true: frozenset[str]
    candidates: Mapping[str, Sequence[str]]
    goal: tuple[str, ...]


def fitted_plan(
    program: str,
    actions: Mapping[str, int],
    problem: Problem,
    confined: Sequence[Mapping[str, Sequence[str]]],
) -> tuple[str, ...] | None:
    """The first plan of exactly so many steps, or None. Raises LimitError.

    `program` has its rules worded for being confined, `actions` their places in the order of
    declaration; `confined` are for each step the functions confined, with the fluents left.
    """
    length = len(confined) - 1
    facts = (*_given(problem, confined[0]), *_within(confined))
    control = ground(
        [program, theory("incremental_fine_planning")], {"n": length}, facts, ["problem"]
    )
    first, *others = parts(length)
    control.ground([first, ("open", []), *others, ("goal", [Number(length)])])
    _prefer(control, actions)
    with solving(control) as model:
        return None if model is None else read(model)


def _given(problem: Problem, confined: Mapping[str, Sequence[str]]) -> Iterator[str]:
    yield from (f"certain({fluent})" for fluent in sorted(problem.true))
    for function, group in problem.candidates.items():
        yield f"group({function})"
        left = set(confined.get(function, group))
        yield from (f"candidate({function},{fluent})" for fluent in group if fluent in left)
    for literal in problem.goal:
        yield f"{'wanted' if is_positive(literal) else 'unwanted'}({atom(literal)})"


def _within(confined: Sequence[Mapping[str, Sequence[str]]]) -> Iterator[str]:
    for step, functions in enumerate(confined):
        for function, fluents in functions.items():
            yield f"confined({function},{step})"
            yield from (f"within({fluent},{step})" for fluent in fluents)


def _prefer(control: clingo.Control, actions: Mapping[str, int]) -> None:
    """Earlier steps count before later ones, and actions in the order of declaration."""
    occurring = sorted(
        (found.symbol.arguments[1].number, actions[str(found.symbol.arguments[0])], found.literal)
        for found in control.symbolic_atoms.by_signature("occurs", 2)
    )
    with control.backend() as backend:
        for level, (_, _, literal) in zip(range(MOST_LEVELS, 0, -1), occurring, strict=False):
            backend.add_heuristic(literal, clingo.HeuristicType.True_, level, level, [])
