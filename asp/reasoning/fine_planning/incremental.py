"""Shortest plans at the fine resolution, zoomed or not, from sessions that are grounded once.

What only large problems need is switched here.
"""

from functools import lru_cache, partial
from itertools import chain

from asp.language import Fluent, Literals, Signature, functions, syntax, without_exogenous
from asp.reasoning.fine_planning.compact_session import CompactDescription, CompactPart, Horizon
from asp.reasoning.fine_planning.large.problem_program import Problem, ProblemPrograms
from asp.reasoning.fine_planning.large.relaxed_reachability import Reach
from asp.reasoning.fine_planning.reference import (
    FinePlan,
    FinePlanner,
    FineStart,
    NoPlan,
    ReferenceFinePlanner,
    function_of,
)
from asp.reasoning.relevance import Relevance
from asp.solving import Recent
from asp.translation import NotCompactError

LARGEST_SESSION: float = 2_000
"""Constants times steps of a session: problems beyond get programs for themselves; inf: none do.

It pays from rooms of 64 cells on, where planning takes 1.5 times as long without, and 6 times as
long in rooms of 400.
"""

LANDMARKS = True
"""Whether programs for single problems are told where plans can pass.

Without, planning takes 1.3 times as long in rooms of 64 cells, 1.9 times in rooms of 400.
"""

MOST_STEPS = 100_000
"""Constants times steps of all sessions: memory grows with that, 100,000 take some 500 MB."""

_MOST_PARTS, _MOST_NARROWED = 32, 1_000


Horizons = Recent[tuple[CompactPart, int], Horizon]
"""Sessions by part and length; each weighs its length times the constants of its part."""


class IncrementalFinePlanner:
    """A `FinePlanner` without tests. Making it may raise NotCompactError.

    What a plan can do without is left out (`Relevance`), what is left gets names by position
    (`CompactPart`), so that problems that differ in names only share sessions; of these there is
    one for each length, asked from a lower bound on
    (`asp.reasoning.fine_planning.large.relaxed_reachability`). Problems whose session would be
    large have a program for themselves, which knows where a plan can pass
    (`asp.reasoning.fine_planning.large.problem_program`).
    """

    def __init__(
        self,
        source: syntax.Source,
        signature: Signature,
        horizons: Horizons | None = None,
        most: int = _MOST_PARTS,
        largest: float | None = None,
    ) -> None:
        """`source` has the physics only.

        At most `most` parts of it are kept. `horizons` may be those of other planners too;
        without, there are up to MOST_STEPS of its own. `largest` stands for LARGEST_SESSION.
        """
        self._constants = signature.constants
        self._functions = functions(source, signature)
        self._relevance = Relevance(without_exogenous(source, signature), signature)
        self._narrowed = lru_cache(_MOST_NARROWED)(CompactDescription(source, signature).part)
        self._largest = LARGEST_SESSION if largest is None else largest
        self._parts: Recent[CompactPart, CompactPart] = Recent(most)
        self._programs: Recent[CompactPart, ProblemPrograms] = Recent(most)
        self._horizons: Horizons = Recent(MOST_STEPS) if horizons is None else horizons

    def plan(
        self, start: FineStart, goal: Literals, limit: int, constants: frozenset[str] | None = None
    ) -> FinePlan | NoPlan:
        """The first of the shortest plans of at most `limit` actions.

        A goal is out of reach if it is even where nothing becomes false again, or if no state
        satisfies it; others of which no plan is found are beyond the limit, though there may be
        none of any length.
        Raises LimitError, and ValueError for a goal about other constants or for candidates that
        are not values of one total function.
        """
        if not all(start.candidates):
            return NoPlan.OUT_OF_REACH
        kept = self._constants if constants is None else constants
        for literal in goal:
            if not kept.issuperset(literal.arguments):
                raise ValueError(f"{literal}: not about what is planned for")
        kept -= self._relevance.spare(chain(start.true, *start.candidates), goal)
        names = self._narrowed(kept)
        problem = self._problem(names, start.within(kept), goal)
        plan = self._search(self._parts.get(names, lambda: names), problem, limit)
        return plan if isinstance(plan, NoPlan) else names.back(plan)

    @property
    def kept(self) -> int:
        """Of how many parts of the description sessions are kept."""
        return len(self._parts)

    def _search(self, part: CompactPart, problem: Problem, limit: int) -> FinePlan | NoPlan:
        possible = chain(problem.true, *problem.candidates.values())
        reach = part.relaxed.reach(possible, problem.goal)
        if reach is None:
            return NoPlan.OUT_OF_REACH
        for length in range(reach.least, limit + 1):
            plan = self._of_length(length, part, problem, reach)
            if plan is not None:
                return plan
            # Where the goal holds in no state at all, no length need be tried.
            if length == reach.least and self._horizon(part, 0).plan((), problem.goal) is None:
                return NoPlan.OUT_OF_REACH
        return NoPlan.BEYOND_LIMIT

    def _of_length(
        self, length: int, part: CompactPart, problem: Problem, reach: Reach
    ) -> FinePlan | None:
        if length * len(part.names) > self._largest:
            made = partial(ProblemPrograms, part, self._functions, LANDMARKS)
            return self._programs.get(part, made).plan(problem, reach, length)
        horizon = self._horizon(part, length)
        return horizon.plan(horizon.start(problem.true, problem.candidates), problem.goal)

    def _horizon(self, part: CompactPart, length: int) -> Horizon:
        weight = length * len(part.names)
        return self._horizons.get((part, length), lambda: Horizon(part, length), weight)

    def _problem(self, part: CompactPart, start: FineStart, goal: Literals) -> Problem:
        """The problem in canonical names. Raises ValueError."""
        candidates: dict[Fluent, tuple[Fluent, ...]] = {}
        for group in map(part.seen, start.candidates):
            function, *others = function_of(group, self._functions)
            candidates[Fluent.of(function, others)] = group
        return Problem(frozenset(part.seen(start.true)), candidates, part.seen(goal))


_HORIZONS: Horizons = Recent(MOST_STEPS)


def fine_planner(source: syntax.Source, signature: Signature) -> FinePlanner:
    """The fastest planner for a description of the physics; all of them share their sessions."""
    try:
        return IncrementalFinePlanner(source, signature, _HORIZONS)
    except NotCompactError:
        return ReferenceFinePlanner(source, signature)
