"""Smallest explanations of a history: exceptions to defaults, events that nobody reported."""

from __future__ import annotations

from dataclasses import dataclass, replace

from asp.reasoning.diagnosis.encoding import (
    Interpretation,
    Problem,
    assumptions,
    explanation_of,
    interpretation,
    observations,
)
from asp.reasoning.diagnosis.history import Explanation
from asp.reasoning.knowledge import Knowledge
from asp.solving import (
    Recent,
    Session,
    answer_sets,
    goal_externals,
    is_satisfiable,
    preferring,
    theory,
)

_FIRST_HORIZON = 16
_FEW, _MANY = 4, 16
_MOST_CONTROLS = 4


class SmallestExplanations:
    """The smallest explanations in one domain; the horizon doubles where a history outgrows it.

    A session counts events up to a number. Most explanations are of a few, for which a small
    session suffices; one that counts further is grounded when it does not.
    """

    def __init__(self, knowledge: Knowledge) -> None:
        self._knowledge = knowledge
        self._defaults = [default.name for default in knowledge.description.defaults]
        self._controls: Recent[tuple[int, int], Session] = Recent(_MOST_CONTROLS)

    def smallest(self, problem: Problem, fewest: tuple[int, int] = (0, 0)) -> Interpretation | None:
        """The first of the smallest explanations, with what follows from it.

        None has fewer events and distrusted reports than the first number of `fewest`, or as many
        and fewer exceptions than the second. None stands for "more events than are counted, or no
        explanation at all", which is left to the reference.
        """
        tried = fewest[0]
        for most in (_FEW, _MANY):
            question = self._question(problem, most)
            if question.possible and tried <= most:
                for events in range(tried, most + 1):
                    least = fewest[1] if events == fewest[0] else 0
                    for exceptions in range(least, len(self._defaults) + 1):
                        found = self._first(question, events, exceptions)
                        if found is not None:
                            return found
            tried = max(tried, most + 1)
        return None

    def keeping(self, problem: Problem, adopted: Explanation) -> Interpretation | None:
        """The first interpretation with exactly these events, reports and exceptions.

        None where there is none, or there are too many of them.
        """
        question = self._question(problem, _FEW if adopted.size <= _FEW else _MANY)
        session = question.session
        assumed = [session.literal("unobserved", a, step) for step, a in adopted.unobserved]
        assumed += [session.literal("distrusted", a, step) for step, a in adopted.distrusted]
        exceptions = [session.literal("exception", name) for name in adopted.exceptions]
        exactly = assumptions((literal, True) for literal in (*assumed, *exceptions))
        if question.given is None or exactly is None or adopted.size > question.most:
            return None
        question = replace(question, given=question.given + exactly)
        return self._first(question, adopted.size, len(exceptions))

    def alternatives(
        self, problem: Problem, adopted: Explanation, most: int
    ) -> tuple[list[Explanation], bool]:
        """Explanations with as many events and distrusted reports, and exceptions, as one.

        With them, whether there are more than `most`; True also where the session cannot tell. If
        the one is smallest, these are all smallest explanations.
        """
        question = self._question(problem, _FEW if adopted.size <= _FEW else _MANY)
        limited = question.at_most(adopted.size, len(adopted.exceptions))
        if limited is None or adopted.size > question.most:
            return [], True
        found, more = answer_sets(question.session.control, limited, most)
        return [explanation_of(shown) for shown in found], more

    def _question(self, problem: Problem, most: int) -> _Question:
        """The session that counts so far, with the problem's externals and observations."""
        # It depends on the history alone, so that budgets do not depend on earlier histories.
        horizon = _FIRST_HORIZON
        while horizon < problem.step:
            horizon *= 2
        session = self._controls.get((horizon, most), lambda: self._made(horizon, most))
        session.switch_on(*goal_externals(problem.goal), *problem.externals)
        return _Question(session, most, problem, observations(session, problem))

    def _first(self, question: _Question, events: int, exceptions: int) -> Interpretation | None:
        """The preferred explanation with at most so many events and exactly so many exceptions."""
        limited = question.at_most(events, exceptions)
        if limited is None:
            return None
        session = question.session
        with preferring(session.control, limited) as model:
            if model is None:
                return None
            return interpretation(session, model, question.problem)

    def _made(self, horizon: int, most: int) -> Session:
        known = self._knowledge
        program = "\n".join([known.program, theory("defaults"), theory("order")])
        ranks, fluents = (*known.ranks, *known.start), known.description.fluents
        return Session(program, "incremental_diagnosis", fluents, ranks, n=horizon, most=most)


@dataclass(frozen=True)
class _Question:
    """A session switched to a problem, and assumptions for everything observed."""

    session: Session
    most: int
    problem: Problem
    given: list[int] | None

    @property
    def possible(self) -> bool:
        """Whether any explanation has at most as many events as are counted."""
        if self.most == _FEW:
            return self.given is not None  # found out while they are counted
        return self.given is not None and is_satisfiable(self.session.control, self.given)

    def at_most(self, events: int, exceptions: int) -> list[int] | None:
        """Assumptions for at most so many events, exactly so many exceptions; None: impossible."""
        step = self.problem.step
        more = self.session.literal("count", step, events + 1) if events < self.most else None
        number = self.session.literal("number_exceptions", exceptions)
        if self.given is None or number is None:
            return None
        return [*self.given, number] if more is None else [*self.given, number, -more]
