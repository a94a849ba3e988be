"""Shortest plans by breadth-first search over operators: what planning costs inside one process."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from benchmarks.operators import Encoding, Operator

State = tuple[int, ...]
Condition = tuple[tuple[int, int], ...]


class Search:
    """An encoding compiled to tuples of small integers."""

    def __init__(self, encoding: Encoding) -> None:
        self._encoding = encoding
        self._number = {name: number for number, name in enumerate(encoding.domain)}
        self._value = {
            name: {value: number for number, value in enumerate(values)}
            for name, values in encoding.domain.items()
        }
        self._index: dict[tuple[int, int], list[tuple[str, Condition, Condition]]] = {}
        for operator in encoding.operators:
            compiled = (operator.action, self._pairs(operator.before), self._pairs(operator.after))
            self._index.setdefault(self._key(operator), []).append(compiled)

    def state(self, true: Iterable[str]) -> State:
        """The state in which these fluents are true."""
        return tuple(value for _, value in sorted(self._pairs(self._encoding.values(true))))

    def successors(self, state: State) -> Iterator[tuple[str, State]]:
        """Each action that can be executed, with the state that it leads to."""
        for entry in enumerate(state):
            for action, before, after in self._index.get(entry, ()):
                if all(state[variable] == value for variable, value in before):
                    following = list(state)
                    for variable, value in after:
                        following[variable] = value
                    yield action, tuple(following)

    def shortest(self, true: Iterable[str], goal: Sequence[str]) -> int | None:
        """The length of a shortest plan; None if there is none."""
        wanted = [self._meets(literal) for literal in goal]
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

    def _meets(self, literal: str) -> tuple[int, int, bool]:
        """The variable and the value of a literal, and whether it is to have this value."""
        variable, value, truth = self._encoding.assignment(literal)
        return self._number[variable], self._value[variable][value], truth

    def _pairs(self, values: Mapping[str, str]) -> Condition:
        return tuple((self._number[name], self._value[name][v]) for name, v in values.items())

    def _key(self, operator: Operator) -> tuple[int, int]:
        """The condition that the fewest states meet. Every operator has one."""
        widest = max(operator.before, key=lambda name: len(self._encoding.domain[name]))
        return self._pairs({widest: operator.before[widest]})[0]
