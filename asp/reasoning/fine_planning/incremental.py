"""Shortest plans at the fine resolution, zoomed or not, from controls that are grounded once."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable
from functools import lru_cache, partial
from itertools import chain

from asp.language import (
    Signature,
    arguments,
    functions,
    ground,
    narrowed,
    restrict,
    subject,
    syntax,
    without_exogenous,
)
from asp.reasoning.fine_planning.abstraction import Narrow, Narrower
from asp.reasoning.fine_planning.horizon_cache import Horizons
from asp.reasoning.fine_planning.large.problem_program import Problem
from asp.reasoning.fine_planning.large.relaxed_reachability import Reach
from asp.reasoning.fine_planning.reference import (
    FinePlan,
    FineStart,
    NoPlan,
    NotCandidatesError,
    plain_plan,
)
from asp.reasoning.fine_planning.restricted_domain import FineDomain
from asp.reasoning.relevance import Relevance
from asp.translation import NotCompactError

_MOST_NARROWED = 1_000
LARGEST_KEPT = 2_000  # constants times steps of a control
MOST_STEPS = 100_000  # of constants: some 500 MB of controls


class FinePlanner:
    """Plans in one refined description, or in parts of it. Making it may raise NotCompactError.

    What a plan can do without is left out (`Relevance`), what is left gets names by position
    (`Narrower`), so that problems that differ in names only share controls; of these there is one
    for each length, asked from a lower bound on
    (`asp.reasoning.fine_planning.large.relaxed_reachability`). Problems whose control would be
    large have one for themselves, which knows where a plan can pass
    (`asp.reasoning.fine_planning.large.problem_program`).
    """

    def __init__(
        self,
        source: syntax.Source,
        signature: Signature,
        most: int = 32,
        horizons: Horizons | None = None,
        largest: int = LARGEST_KEPT,
    ) -> None:
        """`source` has the physics only.

        The controls of at most `most` parts of it are kept, as far as `horizons` does, which may
        be those of other planners too; without, there are up to MOST_STEPS of its own. What
        takes more steps times constants than `largest` gets a control for itself.
        """
        self._constants = signature.constants
        self._functions = functions(source, signature)
        self._relevance = Relevance(without_exogenous(source, signature), signature)
        self._narrower = Narrower(source, signature)
        self._narrow = lru_cache(_MOST_NARROWED)(self._narrower.narrow)
        self._most = most
        self._largest = largest
        self._kept: OrderedDict[object, FineDomain] = OrderedDict()
        self._horizons = Horizons(MOST_STEPS) if horizons is None else horizons

    def plan(
        self,
        start: FineStart,
        goal: tuple[str, ...],
        limit: int,
        constants: frozenset[str] | None = None,
    ) -> FinePlan | NoPlan:
        """The first of the shortest plans of at most `limit` actions.

        Of candidates those are assumed that make it short. `constants` are those of the part of
        the description that is planned in (None: the whole). A goal is out of reach if it is even
        where nothing becomes false again, or if no state satisfies it; others of which no plan is
        found are beyond the limit, though there may be none of any length.
        Raises LimitError, NotCandidatesError, ValueError for a goal about other constants.
        """
        if not all(start.candidates):
            return NoPlan.OUT_OF_REACH
        kept = self._constants if constants is None else constants
        for literal in goal:
            if not kept.issuperset(arguments(literal)):
                raise ValueError(f"{literal}: not about what is planned for")
        kept -= self._relevance.spare(chain(start.true, *start.candidates), goal)
        return self._search(self._narrow(kept), start.within(kept), goal, limit)

    def _search(
        self, narrow: Narrow, start: FineStart, goal: tuple[str, ...], limit: int
    ) -> FinePlan | NoPlan:
        true = frozenset(narrow.seen(start.true))
        candidates = self._by_function(map(narrow.seen, start.candidates))
        wanted = narrow.seen(goal)
        domain = self._domain(narrow)
        reach = domain.relaxed.reach(chain(true, *candidates.values()), wanted)
        if reach is None:
            return NoPlan.OUT_OF_REACH
        problem = Problem(true, candidates, wanted)
        for length in range(reach.least, limit + 1):
            plan = self._of_length(length, domain, problem, reach)
            if plan is not None:
                return narrow.back(plan)
            if length == reach.least and not self._is_consistent(domain, wanted):
                return NoPlan.OUT_OF_REACH
        return NoPlan.BEYOND_LIMIT

    def _is_consistent(self, domain: FineDomain, goal: tuple[str, ...]) -> bool:
        """Whether the goal holds in any state at all; where not, no length need be tried."""
        state = self._horizons.get(domain, 0, domain.size, partial(domain.horizon, 0))
        return state.plan((), goal) is not None

    def _of_length(
        self, length: int, domain: FineDomain, problem: Problem, reach: Reach
    ) -> tuple[str, ...] | None:
        if length * domain.size > self._largest:
            return domain.fitted(problem, reach, length)
        make = partial(domain.horizon, length)
        horizon = self._horizons.get(domain, length, domain.size, make)
        return horizon.plan(horizon.start(problem.true, problem.candidates), problem.goal)

    def _by_function(self, groups: Iterable[tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
        """The groups of candidates by what they give a value. Raises NotCandidatesError."""
        found: dict[str, tuple[str, ...]] = {}
        for group in groups:
            function = subject(group[0], self._functions)
            if function is None:
                message = f"{group[0]}: not a value of a function that always has one"
                raise NotCandidatesError(message)
            found[ground(function[0], function[1:])] = group
        return found

    @property
    def kept(self) -> int:
        """Of how many parts of the description controls are kept."""
        return len(self._kept)

    def _domain(self, narrow: Narrow) -> FineDomain:
        """What is kept of a narrowed description, used last of all."""
        if narrow.key not in self._kept:
            self._kept[narrow.key] = FineDomain(self._narrower, narrow, self._functions)
        self._kept.move_to_end(narrow.key)
        while len(self._kept) > self._most:
            self._horizons.forget(self._kept.popitem(last=False)[1])
        return self._kept[narrow.key]


class LiteralPlanner:
    """Plans as `FinePlanner` does, for any laws: by their literal translation, from scratch."""

    def __init__(self, source: syntax.Source, signature: Signature) -> None:
        self._source = source
        self._signature = signature

    def plan(
        self,
        start: FineStart,
        goal: tuple[str, ...],
        limit: int,
        constants: frozenset[str] | None = None,
    ) -> FinePlan | NoPlan:
        """The first of the shortest plans of at most `limit` actions."""
        kept = self._signature.constants if constants is None else constants
        dropped = self._signature.constants - kept
        source = restrict(self._source, dropped)
        return plain_plan(
            source, narrowed(self._signature, dropped), start.within(kept), goal, limit
        )


def fine_planner(
    source: syntax.Source, signature: Signature, horizons: Horizons | None = None
) -> FinePlanner | LiteralPlanner:
    """The fastest planner for a description of the physics; its controls are in `horizons`."""
    try:
        return FinePlanner(source, signature, horizons=horizons)
    except NotCompactError:
        return LiteralPlanner(source, signature)
