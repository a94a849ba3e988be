"""The states that a history may have led to, each with the smallest explanations that lead there.

They follow step by step, as in the algorithm of Viterbi: whatever is explained later is explained
by one of these states and by what happened after it. Of explanations that lead to the same state
only the smallest can belong to a smallest one of the whole, and of those that are equally small
only the first in the order of `order.lp` to the first one. Late news of a step leaves what is known
of the steps before it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass, replace

from asp.reasoning.diagnosis.belief import BeliefTracker
from asp.reasoning.diagnosis.explanations import Alternatives, Explanation
from asp.reasoning.diagnosis.history import History, Problem
from asp.reasoning.diagnosis.long_histories.arcs import Arc, Arcs
from asp.reasoning.diagnosis.long_histories.paths import (
    Path,
    Paths,
    Ways,
    beginnings,
    continued,
    steps_of,
)
from asp.reasoning.diagnosis.long_histories.steps import ArcsOfState, Steps
from asp.reasoning.diagnosis.smallest_explanations import Interpretation, SmallestExplanations
from asp.solving import BudgetError, State

_MARGIN = 4
_LAYERS_OF_A_DECISION = 3
_ANSWERS_OF_AN_EXPLANATION = 30_000


@dataclass(frozen=True)
class Compression:
    """How a history is compressed.

    From step `after` on; to at most `most` states of a step, with `arcs` from each and `kept`
    explanations of each; with so many `answers` of the solver in a decision that can do without.
    Late news of the last `late` steps leaves what is known of the steps before it.

    An office of four books, whose robot sees one room, has up to 162 states of a step. With room
    for 64 a life of 100 steps took 55 s there and used up 20 budgets, with room for 256 it took 11
    s and used up none. Where there are fewer states the room costs nothing.
    """

    after: int = 32
    most: int = 256
    arcs: int = 256
    kept: int = 3
    answers: int = 1_000
    late: int = 64


@dataclass(frozen=True)
class Layer:
    """The smallest paths to each state of a step, of all those that have at most a size."""

    paths: Paths
    limit: float

    @property
    def smallest(self) -> list[Sequence[Path]]:
        """The paths that are as small as any, by the states that they lead to."""
        least = min((paths[0].price for paths in self.paths.values()), default=None)
        return [paths for paths in self.paths.values() if paths[0].price == least]


class Frontier:
    """The layers of one history, which grows.

    Where a layer has more states than the settings allow, those that take most are left out: the
    limit of this layer, and of all that follow, is lowered.
    """

    def __init__(
        self,
        arcs: Arcs,
        explanations: SmallestExplanations,
        tracker: BeliefTracker,
        settings: Compression,
    ) -> None:
        """`explanations` are those of histories that begin."""
        self._steps = Steps(arcs, tracker, settings.arcs)
        self._whole = arcs.most_assumed
        self._explanations = explanations
        self._tracker = tracker
        self._settings = settings
        self._first_step = 0
        self._layers: list[Layer] = []
        self._last: Layer | None = None

    @property
    def step(self) -> int:
        """The step of the last layer; -1 where there is none."""
        return self._first_step + len(self._layers) - 1

    def copy(self) -> Frontier:
        """The layers so far of a history that may go on otherwise."""
        other = copy(self)
        other._steps, other._layers = self._steps.copy(), [*self._layers]
        return other

    def forget(self, since: int) -> None:
        """Takes back the layers from a step on."""
        self._last = None
        if since <= self._first_step:
            self._layers, self._first_step = [], 0
        else:
            del self._layers[since - self._first_step :]

    def follow(self, history: History) -> None:
        """Adds a few layers.

        Raises LimitError, also where that takes more answers of the solver than are allowed; those
        that it has are remembered.
        """
        self._last = None
        self._steps.answers = self._settings.answers
        self._advance(history, min(history.step - 1, self.step + _LAYERS_OF_A_DECISION))

    def least(self, history: History) -> tuple[int, int] | None:
        """The price of the smallest explanations of a history; None where it is not known.

        Raises LimitError.
        """
        ends = self._ends(history)
        return ends[0][0].price if ends else None

    def smallest(self, history: History) -> Interpretation | None:
        """The first of the smallest explanations of a history; None where it is not known.

        Raises LimitError.
        """
        firsts = (paths[0] for paths in self._ends(history))
        first = min(firsts, key=lambda path: path.order, default=None)
        return None if first is None else first.interpretation

    def keeping(self, history: History, adopted: Explanation) -> Interpretation | None:
        """The first interpretation with the events, reports and exceptions of an explanation.

        None where there is none, and where that is not known. Raises LimitError.
        """
        self._steps.answers = _ANSWERS_OF_AN_EXPLANATION
        try:
            return self._kept(history, adopted)
        except BudgetError:
            return None

    def alternatives(
        self, history: History, adopted: Explanation, most: int
    ) -> Alternatives | None:
        """At most so many smallest explanations of a history, and whether there are more of them.

        None where that is not known, or the one is not as small. Raises LimitError.
        """
        ends, kept = self._ends(history), self._settings.kept
        if not ends or ends[0][0].price != adopted.price:
            return None
        in_order = sorted((p for paths in ends for p in paths[:kept]), key=lambda path: path.order)
        found = list(dict.fromkeys(path.explanation for path in in_order))
        return found[:most], len(found) > most or any(len(paths) > kept for paths in ends)

    def _ends(self, history: History) -> list[Sequence[Path]]:
        """The smallest paths to the history's step, by states; none where they are not known.

        What is observed of this step is not complete before the next one: its layer is not kept.
        """
        if self._last is None:
            self._steps.answers = _ANSWERS_OF_AN_EXPLANATION
            try:
                self._advance(history, history.step - 1)
                self._last = self._next(history)
            except BudgetError:
                return []
        return self._last.smallest

    def _advance(self, history: History, until: int) -> None:
        if not self._layers:
            self._layers.append(self._begin(history))
        while self.step < until:
            self._layers.append(self._next(history))
            if len(self._layers) > self._settings.late:
                self._first_step += 1
                del self._layers[0]

    def _begin(self, history: History) -> Layer:
        problem = Problem(self._tracker.goal, {0: self._steps.record(history, 0)}, 0, 0)
        most = self._settings.most
        found, left_off = self._explanations.outcomes(problem, 0).all(0, None, most)
        if left_off:
            return Layer({}, -1)
        return Layer(beginnings(found, self._tracker.knowledge.description), self._whole)

    def _next(self, history: History) -> Layer:
        """The layer after the last one."""
        layer = self._layers[-1]
        arcs = self._steps.arcs(history, self.step)
        agrees = self._steps.agreeing(history, self.step + 1)
        limit = layer.limit
        while (ways := self._ways(layer.paths, arcs, agrees, limit)) is None:
            least = min(paths[0].size for paths in layer.paths.values())
            limit = min(limit - 1, least + _MARGIN)
        return Layer(continued(ways, self._settings.kept + 1), limit)

    def _ways(
        self, paths: Paths, arcs: ArcsOfState, agrees: Callable[[State], bool], limit: float
    ) -> Ways | None:
        """How paths go on within a limit, to each state the smallest; None: to too many states."""
        prices: dict[State, tuple[int, int]] = {}
        ways: dict[State, list[tuple[Path, Arc]]] = {}
        for state, before in paths.items():
            size, exceptions = before[0].price
            found = arcs(state, limit - size) if size <= limit else ()
            if found is None:
                return None
            for arc in found:
                price, after = (size + arc.size, exceptions), arc.after
                known = prices.get(after)
                if known == price:
                    ways[after] += ((path, arc) for path in before)
                elif (known is None or price < known) and agrees(after):
                    prices[after], ways[after] = price, [(path, arc) for path in before]
        return None if len(ways) > self._settings.most else ways

    def _kept(self, history: History, adopted: Explanation) -> Interpretation | None:
        assumed, is_whole = steps_of(adopted), self._layers[-1].limit >= self._whole
        begun = (path for paths in self._begin(history).paths.values() for path in paths)
        alive = {path.state: path for path in begun if path.exceptions == adopted.exceptions}
        for step in range(history.step):
            wanted = assumed.get(step, Explanation())
            arcs, agrees = self._steps.arcs(history, step), self._steps.agreeing(history, step + 1)
            following: dict[State, Path] = {}
            for path in alive.values():
                found = arcs(path.state, self._whole if is_whole else wanted.size) or ()
                after = next((arc.after for arc in found if arc.explanation == wanted), None)
                if after is None or not agrees(after):
                    continue
                known = following.get(after)
                if known is None or path.order < known.order:
                    following[after] = replace(path, before=path, last=wanted, state=after)
            alive = following
        first = min(alive.values(), key=lambda path: path.order, default=None)
        return None if first is None else first.interpretation
