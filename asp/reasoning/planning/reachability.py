"""Goals that no plan of any length achieves."""

from asp.language import Description
from asp.reasoning.knowledge import Goal
from asp.reasoning.laws import laws, term
from asp.reasoning.planning.incremental import IncrementalPlanner
from asp.reasoning.successors import Transitions
from asp.solving import Answers, State, fact, first_model, ground, theory

_MOST_STATES = 2_000

MOST_ANSWERS = 1_000
"""How many answers are remembered."""


class Reachability:
    """Proves that a goal is out of reach of the agent's own actions, or in reach, where it can.

    It is out of reach if no state satisfies it, or if one of its literals can never become true
    even where laws ask for no more than each condition by itself. Else every state that can be
    reached is looked at: by a search where there is one, else one by one, where
    nothing is said of a state with more than some thousand of those.
    """

    def __init__(
        self, description: Description, transitions: Transitions, plans: IncrementalPlanner
    ) -> None:
        """`plans` are of the description, too."""
        self._fluents = description.fluents
        self._laws = list(laws(description))
        self._transitions = transitions
        self._plans = plans
        self._answers: Answers[object, bool | None] = Answers(MOST_ANSWERS)

    def reachable(self, state: State, goal: Goal) -> bool | None:
        """Whether some plan, of any length, leads from the state to the goal; None: not known.

        Raises LimitError.
        """
        return self._answers.get((state, goal), lambda: self._decide(state, goal))

    def _decide(self, state: State, goal: Goal) -> bool | None:
        if not self._transitions.satisfiable(goal) or self._relaxed(state, goal):
            return False
        reachable = self._plans.reachable(state, goal)
        return self._explored(state, goal) if reachable is None else reachable

    def _relaxed(self, state: State, goal: Goal) -> bool:
        """Whether some literal of a goal can never become true, however little laws ask for."""
        facts = [fact("wanted", term(literal)) for literal in goal]
        facts += (
            fact("initially", term(fluent if fluent in state else fluent.complement))
            for fluent in self._fluents
        )
        return bool(first_model(ground([theory("reach")], {}, [*self._laws, *facts])))

    def _explored(self, state: State, goal: Goal) -> bool | None:
        """Whether a state that can be reached satisfies a goal; None where these are too many."""
        found, left = {state}, [state]
        while left:
            new = self._transitions.successors(left.pop()) - found
            found |= new
            left += new
            if len(found) > _MOST_STATES:
                return None
        return any(all((each.atom in one) == each.is_positive for each in goal) for one in found)
