"""A coarse game that is played by tables; its core catches up when somebody looks at it.

What a step changes and shows is looked up by the state and both answers, and found out where it is
asked for the first time. Nothing is remembered of a step but both answers: the core plays them when
its situation is asked for, with the same random numbers, so that it is where it would be had it
played all along.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from testbed.environment.core import Core
from testbed.environment.observation import Observation, Vector, vector
from testbed.environment.rules import ADVERSARY, ROBOT, Ending, Rewards, Situation
from testbed.protocol import FINISH, NONE, WAIT

Int8s = NDArray[np.int8]
MOST_ROWS = 50_000
"""Positions that are remembered; beyond, all are forgotten and found out anew."""
_NUMBERS: dict[Ending | None, int] = {own: n for n, own in enumerate((None, *Ending))}
"""Outcomes by number in numeric infos (`testbed.environment.conventions.OUTCOMES`)."""


@dataclass(slots=True)
class Beside:
    """What there is beside an answer of the robot at a position.

    `sees` and `legal` are the adversary's, `happens` says whether the answer takes effect (1, -1;
    0: it is none that could), `ending` how it ends the game. `following` has, by the number of the
    event, the rows of the positions of which one follows.
    """

    sees: Vector
    legal: Int8s
    happens: int
    ending: Ending | None
    following: "dict[int, tuple[Row, ...]]" = field(default_factory=dict)


@dataclass(slots=True)
class Row:
    """What there is at a position: the state, and what is beside the robot's answers."""

    position: int
    state: int
    is_answered: bool
    robot_sees: Vector
    state_sees: Vector
    beside: dict[int, Beside] = field(default_factory=dict)


class TabledGame:
    """Plays a core by tables, position by position.

    A position is the state of the world, and whether a wrong `finish` has just been answered: of
    state s these are 2 s and 2 s + 1. What else the rest of a game may depend on, tables do not
    know: `has_tables`.
    """

    def __init__(self, core: Core) -> None:
        self._core = core
        self._rows: dict[int, Row] = {}
        self._goal, self._most_steps = vector(core.world.fluents, core.rules.goal), core.rules.steps
        self.answers, self.events = len(core.robot_actions), len(core.adversary_actions)
        self._chosen = np.eye(self.answers, dtype=np.int8)
        self._every_answer = np.ones(self.answers, np.int8)
        self._play_on = self._catch_up
        self._anchor: Situation | None = None
        self._random: Any = None
        self._since: list[tuple[int, int]] = []
        self._row: Row | None = None
        self._step = self._happened = 0
        self.ending: Ending | None = None

    def is_under_way(self) -> bool:
        """Whether a game is under way that has tables: else the core has to be asked."""
        core = self._core
        if core.now is not self._anchor or (self._since and core.catch_up is None):
            self._arrive()
        return self._row is not None and self.ending is None

    def play(self, own: int, other: int) -> bool:
        """Play a step; False: the event is illegal, and nothing has changed."""
        row = self._row
        assert row is not None
        beside = row.beside.get(own) or self._beside(row, own)
        following = beside.following.get(other)
        if following is None:
            if not beside.legal[other]:
                return False
            following = self._follow(row, beside, own, other)
        if len(following) == 1:
            self._row = following[0]
        else:
            self._row = self._drawn(following)
        self._since.append((own, other))
        self._core.catch_up = self._play_on
        self._happened, self.ending = beside.happens, beside.ending
        if self._step >= self._most_steps and self.ending is None:
            self.ending = Ending.STEP_LIMIT
        self._step += 1
        return True

    def observe(self, agent: str, own: int | None) -> Observation | None:
        """What an agent sees, as new arrays; None where the core has to be asked.

        That is so of an adversary that knows of no answer, and of a game that has no tables.
        """
        core = self._core
        if core.now is not self._anchor or (self._since and core.catch_up is None):
            self._arrive()
        row = self._row
        if row is None:
            return None
        if agent == ROBOT:
            mask = self._every_answer if self.ending is None else self._chosen[0]
            return {"observation": row.robot_sees.copy(), "action_mask": mask.copy()}
        if own is None or agent != ADVERSARY:
            return None
        beside = row.beside.get(own) or self._beside(row, own)
        return {"observation": beside.sees.copy(), "action_mask": beside.legal.copy()}

    def info(self, agent: str, own: int | None) -> dict[str, Any]:
        """The numeric infos of an agent, as `testbed.environment.conventions` has them."""
        row = self._row
        assert row is not None
        outcome = 0 if self.ending is None else _NUMBERS[self.ending]
        if agent == ROBOT:
            return {
                "step": self._step,
                "outcome": outcome,
                "goal": self._goal.copy(),
                "happened": self._happened,
                "goal_holds": -1 if row.is_answered else 0,
                "illegal": 0,
            }
        return {
            "step": self._step,
            "outcome": outcome,
            "goal": self._goal.copy(),
            "robot_action": -1 if own is None else own,
            "illegal": 0,
        }

    def _arrive(self) -> None:
        """Go on from where somebody else has led the core."""
        now = self._core.now
        self._anchor, self._random, self._since, self._row = now, None, [], None
        if now is not None and now.ending is None:
            self._step, self.ending = now.step, None
            self._happened = 0 if now.happened is None else 1 if now.happened else -1
            position = 2 * now.state + (now.goal_holds is False)
            self._row = self._at(position)

    def _catch_up(self) -> None:
        """Bring the core to the present moment."""
        core, since, self._since = self._core, self._since, []
        if self._random is not None:
            core.random_state = self._random
        for own, other in since:
            core.advance(core.robot_actions[own], core.adversary_actions[other])
        self._anchor, self._random = core.now, None

    def _found(self, position: int) -> Row:
        if len(self._rows) >= MOST_ROWS:
            for known in self._rows.values():
                known.beside.clear()  # rows lead to each other
            self._rows.clear()
        core, state = self._core, position >> 1
        row = self._rows[position] = Row(
            position=position,
            state=state,
            is_answered=bool(position & 1),
            robot_sees=vector(core.world.fluents, core.execution.visible(state)),
            state_sees=vector(core.world.fluents, core.world.literals(state)),
        )
        return row

    def _beside(self, row: Row, own: int) -> Beside:
        core, action = self._core, self._core.robot_actions[own]
        legal = core.legality.events(Situation("", 1, row.state, core.rules.goal), action)
        mask = [legal.allows(event) for event in core.adversary_actions]
        possible = core.execution.possible(row.state, action)
        beside = row.beside[own] = Beside(
            sees=np.concatenate([row.state_sees, self._chosen[own]]),
            legal=np.array(mask, np.int8),
            happens=0 if action in (WAIT, FINISH) else 1 if possible else -1,
            ending=self._ending(row) if action == FINISH else None,
        )
        return beside

    def _ending(self, row: Row) -> Ending | None:
        """How `finish` ends the game; None where it is answered (see `Rules`)."""
        rules = self._core.rules
        if self._core.world.satisfies(row.state, rules.goal):
            return Ending.ACHIEVED
        return None if rules.goal_feedback and not row.is_answered else Ending.FALSE_FINISH

    def _follow(self, row: Row, beside: Beside, own: int, other: int) -> tuple[Row, ...]:
        core, action = self._core, self._core.robot_actions[own]
        event = core.adversary_actions[other]
        effective = core.execution.physical(action) if beside.happens > 0 else ()
        compound = effective if event == NONE else (*effective, event)
        is_answered = action == FINISH and beside.ending is None
        states = core.world.successors(row.state, compound)
        found = tuple(self._at(2 * state + is_answered) for state in states)
        beside.following[other] = found
        return found

    def _drawn(self, rows: tuple[Row, ...]) -> Row:
        """One of several, drawn as the core draws it."""
        if self._random is None:
            self._random = self._core.random_state
        return self._at(self._core.draw(tuple(row.position for row in rows)))

    def _at(self, position: int) -> Row:
        return self._rows.get(position) or self._found(position)


def has_tables(core: Core) -> bool:
    """Whether the rest of a core's game depends on position and step alone.

    It does not at the fine resolution, where a goal is drawn, where events are bounded by what was
    played, where the robot is told of events, and where rewards are not those by default.
    """
    rules = core.rules
    reports = rules.observability.values()
    return (
        not (core.execution.sensing or core.execution.statistics or core.draw_goal)
        and not core.allowance.highest
        and all(own.mode == "never" and not own.false_reports for own in reports)
        and rules.rewards == Rewards()
        and not rules.adversary.cost
    )
