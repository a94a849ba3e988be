"""Shortest plans by breadth-first search, state by state: what planning costs in one process."""

from collections.abc import Collection, Iterator, Sequence

from asp.language import Action, Fluent, Literal
from asp.reasoning.planning import Encoding, Operator, Values

State = tuple[int, ...]


class Search:
    """An encoding whose operators are found by one value that they ask for."""

    def __init__(self, encoding: Encoding) -> None:
        self._encoding = encoding
        self._index: dict[tuple[int, int] | None, list[tuple[Action, Values, Values]]] = {}
        for operator in encoding.operators:
            compiled = (operator.action, operator.before, operator.after)
            self._index.setdefault(self._key(operator), []).append(compiled)

    def state(self, true: Collection[Fluent]) -> State:
        """The state in which these fluents are true. Raises ValueError where it is none."""
        state = self._encoding.values(true)
        if state is None:
            raise ValueError(f"no state has just these fluents: {', '.join(sorted(true))}")
        return state

    def successors(self, state: State) -> Iterator[tuple[Action, State]]:
        """Each action that can be executed, with the state that it leads to."""
        for entry in (None, *enumerate(state)):
            for action, before, after in self._index.get(entry, ()):
                if all(state[variable] == value for variable, value in before):
                    following = list(state)
                    for variable, value in after:
                        following[variable] = value
                    yield action, tuple(following)

    def shortest(self, true: Collection[Fluent], goal: Sequence[Literal]) -> int | None:
        """The length of a shortest plan; None if there is none."""
        wanted = [self._encoding.assignment(literal) for literal in goal]
        start = self.state(true)
        seen, frontier, length = {start}, [start], 0
        while frontier:
            if any(all((s[v] == x) == truth for v, x, truth in wanted) for s in frontier):
                return length
            following: list[State] = []
            for state in frontier:
                for _, reached in self.successors(state):
                    if reached not in seen:
                        seen.add(reached)
                        following.append(reached)
            frontier, length = following, length + 1
        return None

    def _key(self, operator: Operator) -> tuple[int, int] | None:
        """The condition that the fewest states meet, if there is any."""
        domains = self._encoding.domains
        return max(operator.before, key=lambda entry: len(domains[entry[0]]), default=None)
