"""The checks of a game: its robot's decisions, one after the other, against brute force."""

from collections.abc import Iterator

from benchmarks.games.believing import (
    alternative_faults,
    belief_faults,
    contradiction_faults,
    explanation_faults,
    unheeded_faults,
)
from benchmarks.games.drawing import SLOW, Game
from benchmarks.games.explaining import Assumptions, Search
from benchmarks.games.faults import Fault, Turn
from benchmarks.games.intending import Intentions, PlanInHand
from benchmarks.games.office import State
from benchmarks.games.sure import CheckedOffice
from benchmarks.games.told import Rules, Told
from testbed.protocol import Decision, Percept


class Checker:
    """Follows a game, and finds what is wrong with each decision."""

    def __init__(self, game: Game) -> None:
        self._game = game
        office, goal, start = game.office, game.goal, game.state
        if game.robot == "intentional-checking":
            office = CheckedOffice(office, goal)
            goal, start = (*goal, *office.sure), office.from_start(start)
        rules = Rules(office, goal, game.knows_all, game.has_intentions, game.relevance)
        self._told = Told.beginning(rules, start)
        self._search = Search(self._told)
        self._adopted, self._is_proved = Assumptions(), True
        self._believed: tuple[int, State | None] = (0, start if game.knows_all else None)
        self._mind = Intentions(game.is_joint) if game.has_intentions else PlanInHand()

    def check(self, percept: Percept, decision: Decision) -> list[Fault]:
        """The faults of the next decision."""
        self._told.hear(percept)
        trace, before = decision.trace, self._adopted.left(self._told)
        if trace.explanation is not None:
            self._is_proved = trace.explanation.minimal == "proved"
        told, held = trace.explanation, self._adopted
        self._adopted = before if told is None else Assumptions.of(told)
        turn = Turn(
            told=self._told,
            search=self._search,
            percept=percept,
            decision=decision,
            before=before,
            adopted=self._adopted,
            is_completed=told is not None and self._adopted == held,
            ends=self._search.outcomes(self._adopted),
            is_proved=self._is_proved,
            is_limited=self._game.is_limited,
            plan_limit=self._game.plan_limit,
        )
        faults = [*(self._decided(turn) if trace.intention else self._waited(turn))]
        self._told.decide(decision, turn.state)
        return faults

    def _decided(self, turn: Turn) -> Iterator[Fault]:
        trace, (since, believed) = turn.decision.trace, self._believed
        yield from explanation_faults(turn, keeps=not self._game.is_joint)
        if trace.explanation is not None and believed is not None:
            yield from contradiction_faults(turn, since, believed)
        if isinstance(self._mind, PlanInHand):
            if trace.belief:
                yield from belief_faults(turn)
            yield from self._mind.faults(turn)
        else:
            yield from alternative_faults(turn)
            yield from belief_faults(turn)
            if turn.state is not None:
                yield from unheeded_faults(turn, turn.state)
                yield from self._mind.faults(turn, turn.state)
        if trace.belief:
            self._believed = turn.step, turn.state

    def _waited(self, turn: Turn) -> Iterator[Fault]:
        """A decision that reached a limit: the robot waits, and what it explained stands."""
        if not turn.is_limited and self._game.robot not in SLOW:
            yield turn.fault("reason", f"has no intention: {turn.decision.trace.reason}")
        if turn.decision.trace.explanation is not None:
            yield from explanation_faults(turn, keeps=not self._game.is_joint)
        if isinstance(self._mind, PlanInHand):
            self._mind.reconsider(turn)
