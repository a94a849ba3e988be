"""Explanations of a history by brute force: a forward search over states and prices (D 2.4).

The price of an explanation is the number of events and of false reports that it assumes, and then
of exceptions to defaults. From each state that can be at a step, each set of events is tried.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import chain, combinations
from typing import NamedTuple

from benchmarks.games.office import State
from benchmarks.games.told import Moment, Told
from testbed import protocol

Price = tuple[int, int]
Happening = tuple[int, str]


class Node(NamedTuple):
    """A state, and how many actions of the activity in progress are over; -1: there is none."""

    state: State
    done: int


@dataclass(frozen=True)
class Assumptions:
    """What an explanation assumes: events, reports that are false, exceptions to defaults."""

    events: frozenset[Happening] = frozenset()
    distrusted: frozenset[Happening] = frozenset()
    exceptions: frozenset[str] = frozenset()

    @classmethod
    def of(cls, told: protocol.Explanation) -> "Assumptions":
        """Those of an explanation as a trace has it."""
        return cls(
            frozenset((event.step, str(event.action)) for event in told.unobserved),
            frozenset((event.step, str(event.action)) for event in told.distrusted),
            frozenset(map(str, told.exceptions)),
        )

    @property
    def price(self) -> Price:
        return len(self.events) + len(self.distrusted), len(self.exceptions)

    def left(self, told: Told) -> "Assumptions":
        """What is left to assume after some of the events were reported."""
        events = (each for each in self.events if each[1] not in told.at(each[0]).reports)
        return Assumptions(frozenset(events), self.distrusted, self.exceptions)

    def at(self, step: int) -> "Part":
        """What it assumes of a step."""
        events, distrusted = (
            frozenset(action for time, action in each if time == step)
            for each in (self.events, self.distrusted)
        )
        return Part(events, distrusted)

    def __str__(self) -> str:
        events = [f"{action} at {step}" for step, action in sorted(self.events)]
        false = [f"no {action} at {step}" for step, action in sorted(self.distrusted)]
        return ", ".join([*events, *false, *sorted(self.exceptions)]) or "nothing"


class Part(NamedTuple):
    """What an explanation assumes of one step."""

    events: frozenset[str] = frozenset()
    distrusted: frozenset[str] = frozenset()

    @property
    def price(self) -> int:
        return len(self.events) + len(self.distrusted)


Layer = dict[Node, Price]


@dataclass
class Search:
    """The smallest explanations of a history that grows.

    `layers` has by step the least price of each node, of those that cost at most `bound`; what
    is observed at the last step is not looked at in it yet.
    """

    told: Told
    bound: int = 0
    layers: list[Layer] = field(default_factory=list)

    def __post_init__(self) -> None:
        office = self.told.rules.office
        known = (s for s in office.states if office.agrees(s, self.told.known))
        self.starts = {Node(state, -1): office.exceptions(state) for state in known}

    def smallest(self, bound: int) -> Price | None:
        """The price of a smallest explanation, if it has at most so many events; None: none has."""
        return min(self._ends(bound).values(), default=None)

    def ends(self, price: Price) -> list[Node]:
        """Where explanations of this price lead to, which is that of smallest ones."""
        return [node for node, own in self._ends(price[0]).items() if own == price]

    def _ends(self, bound: int) -> Layer:
        if bound > self.bound or not self.layers:
            self.bound = max(bound, self.bound)
            self.layers = [{node: (0, len(exceptions)) for node, exceptions in self.starts.items()}]
        del self.layers[self.told.changed + 1 :]
        while len(self.layers) <= self.told.step:
            self.layers.append(self._next(len(self.layers) - 1))
        step = self.told.step
        return {n: price for n, price in self.layers[step].items() if self._agrees(n, step)}

    def _next(self, step: int) -> Layer:
        found: Layer = {}
        for node, (size, exceptions) in self.layers[step].items():
            for part, after in self.ways(node, step, self.bound - size):
                price = size + part.price, exceptions
                if price < found.get(after, (self.bound + 1, 0)):
                    found[after] = price
        return found

    def _agrees(self, node: Node, step: int) -> bool:
        """Whether nothing that is observed at the step contradicts the state."""
        moment, rules = self.told.at(step), self.told.rules
        goal = moment.goal is None or rules.office.agrees(node.state, rules.goal) == moment.goal
        return goal and rules.office.agrees(node.state, moment.observed)

    def ways(self, node: Node, step: int, most: int) -> Iterator[tuple[Part, Node]]:
        """What may have happened at a step, at a price of at most `most`, and led to which node."""
        if not self._agrees(node, step):
            return
        moment, rules = self.told.at(step), self.told.rules
        room = most if step >= rules.since else 0
        compounds = rules.office.compounds(node.state, max(room, 0))
        for distrusted in map(frozenset, _subsets(moment.reports, room)):
            for events in compounds:
                part = Part(events, distrusted)
                if part.price <= room and events.isdisjoint(moment.reports):
                    after = self.after(node, step, part)
                    if after is not None:
                        yield part, after

    def after(self, node: Node, step: int, part: Part) -> Node | None:
        """The next node where this is what happened unseen; None where the history denies it."""
        moment, office = self.told.at(step), self.told.rules.office
        actions = (moment.reports - part.distrusted) | part.events
        happened = moment.attempt is not None and office.possible(node.state, moment.attempt)
        if happened != moment.happened:
            return None
        if moment.attempt is not None and happened:
            actions |= {moment.attempt}
        state = office.after(node.state, actions)
        return None if state is None else Node(state, self._done(node, step, moment))

    def _done(self, node: Node, step: int, moment: Moment) -> int:
        """How far the activity is after a step (1)-(3), (7)-(9)."""
        if moment.started is not None or moment.stopped:
            return -1 if moment.stopped else 0
        if (
            node.done < 0
            or not moment.happened
            or self.told.rules.office.agrees(node.state, self.told.rules.goal)
        ):
            return node.done
        ahead = self.told.plan_at(step)[node.done : node.done + 1]
        return node.done + (ahead == (moment.attempt,))

    def outcomes(self, assumed: Assumptions) -> set[Node]:
        """Where a history leads to by an explanation; nowhere: it does not explain it."""
        return set(self.explained(assumed).values())

    def explained(self, assumed: Assumptions) -> dict[Node, Node]:
        """The first nodes from which an explanation explains the history, with the last ones."""
        nodes = {node: node for node, own in self.starts.items() if own == assumed.exceptions}
        for step in range(self.told.step):
            part = assumed.at(step)
            reports = self.told.at(step).reports
            if not part.distrusted <= reports or not part.events.isdisjoint(reports):
                return {}
            if part.price and step < self.told.rules.since:
                return {}
            agreeing = [(s, node) for s, node in nodes.items() if self._agrees(node, step)]
            afters = ((start, self.after(node, step, part)) for start, node in agreeing)
            nodes = {start: after for start, after in afters if after is not None}
        return {s: node for s, node in nodes.items() if self._agrees(node, self.told.step)}

    def every(self, price: Price) -> Iterator[Assumptions]:
        """The smallest explanations, whose price this is."""
        left = self._left(price[0])
        begun: defaultdict[frozenset[str], set[Node]] = defaultdict(set)
        for node, exceptions in self.starts.items():
            if len(exceptions) == price[1] and left[0].get(node) == price[0]:
                begun[exceptions].add(node)
        for exceptions, nodes in begun.items():
            for parts in self._parts(0, nodes, price[0], left):
                events, distrusted = (
                    frozenset((i, a) for i, part in enumerate(parts) for a in part[which])
                    for which in range(2)
                )
                yield Assumptions(events, distrusted, exceptions)

    def _parts(
        self, step: int, nodes: Iterable[Node], most: int, left: list[Mapping[Node, int]]
    ) -> Iterator[tuple[Part, ...]]:
        """What happened unseen from a step on, by each smallest explanation."""
        if step == self.told.step:
            yield ()
            return
        found: defaultdict[Part, set[Node]] = defaultdict(set)
        for node in nodes:
            for part, after in self.ways(node, step, most):
                if left[step + 1].get(after) == most - part.price:
                    found[part].add(after)
        for part, nodes_after in found.items():
            for rest in self._parts(step + 1, nodes_after, most - part.price, left):
                yield (part, *rest)

    def _left(self, bound: int) -> list[Mapping[Node, int]]:
        """By step, the least that is still to be assumed from each node on."""
        left: list[Mapping[Node, int]] = [dict.fromkeys(self._ends(bound), 0)]
        for step in range(self.told.step - 1, -1, -1):
            own: dict[Node, int] = {}
            for node, (size, _) in self.layers[step].items():
                ways = self.ways(node, step, bound - size)
                prices = [p.price + left[0][a] for p, a in ways if a in left[0]]
                if prices:
                    own[node] = min(prices)
            left.insert(0, own)
        return left


def _subsets(reports: frozenset[str], most: int) -> Iterator[tuple[str, ...]]:
    numbers = range(min(len(reports), max(most, 0)) + 1)
    return chain.from_iterable(combinations(sorted(reports), number) for number in numbers)
