"""Smallest explanations of a history of which only the end is explained, from a frontier on.

The end is explained from each state of the frontier, as a history of which all is known at first.
"""

from collections.abc import Iterator, Sequence

from asp.reasoning.diagnosis.encoding import Interpretation, Problem
from asp.reasoning.diagnosis.history import Explanation
from asp.reasoning.diagnosis.long_histories.frontier import Frontier, joined
from asp.reasoning.diagnosis.smallest_explanations import FEW, Question, SmallestExplanations
from asp.reasoning.knowledge import Knowledge

LENGTH = 24
"""How many steps the end of a history may have."""


class SuffixExplanations:
    """What explains the end of a history in one domain, and with it the whole."""

    def __init__(self, knowledge: Knowledge) -> None:
        self._ends = SmallestExplanations(knowledge, begins=False)

    def smallest(self, frontier: Frontier, problem: Problem, fewest: int) -> Interpretation | None:
        """The first of the smallest explanations of a history, not smaller than `fewest`.

        None where the frontier does not know all of those that are as small. Raises LimitError.
        """
        question = self._question(frontier, problem)
        if question is None:
            return None
        for size in range(max(fewest, frontier.least), _largest(frontier) + 1):
            found = [
                joined(entry[0], end, frontier.step)
                for entry, asked, room in _entries(frontier, question, size)
                if (end := asked.first(room)) is not None
            ]
            if found:
                return min(found, key=lambda whole: frontier.order(whole.explanation))
        return None

    def alternatives(
        self, frontier: Frontier, problem: Problem, size: int, most: int
    ) -> tuple[list[Explanation], bool] | None:
        """At most so many explanations of the smallest size, and whether there are more of them.

        None where the frontier does not know. Raises LimitError.
        """
        question = self._question(frontier, problem)
        if question is None or not frontier.least <= size <= _largest(frontier):
            return None
        found: list[Explanation] = []
        more = False
        for entry, asked, room in _entries(frontier, question, size):
            ends, left_off = asked.all(room, None, most)
            prefixes = entry[: frontier.kept]
            found += (
                prefix.explanation.followed_by(end, frontier.step)
                for end in ends
                for prefix in prefixes
            )
            more = more or left_off or (bool(ends) and len(prefixes) < len(entry))
        return found[:most], more or len(found) > most

    def _question(self, frontier: Frontier, problem: Problem) -> Question | None:
        """What there is to explain of the end; None where it is too long."""
        suffix = problem.suffix(frontier.step)
        return self._ends.question(suffix, FEW) if suffix.step <= LENGTH else None


def _largest(frontier: Frontier) -> int:
    """The size up to which all explanations are found from a frontier on."""
    return min(frontier.limit, frontier.least + FEW)


def _entries(
    frontier: Frontier, question: Question, size: int
) -> Iterator[tuple[Sequence[Interpretation], Question, int]]:
    """The entries of at most a size, with the end of the history from there, and what is left."""
    for entry in frontier.entries.values():
        room = size - entry[0].explanation.size
        if room >= 0:
            start = question.session.assume_state(entry[0].state, 0)
            yield entry, question.assuming(start), room
