"""Adversaries that play what was written down: a scenario's triggers, or an explicit script."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from agents.adversary.base import AdversaryView, Game, Sight
from asp.language import Action, Literal, Trigger
from testbed.protocol import NONE

T = TypeVar("T")


class Triggered:
    """Fires a scenario's exogenous action when one of its triggers applies, once per trial.

    Where the triggers draw values, these are drawn one after the other, and only triggers with all
    of them may fire: a draw may come to nothing, and is repeated at the next step
    (docs/action-language.md). Where nothing is drawn, the first possible event in order is taken. A
    trigger upon any action fires at every step that the environment leaves open, also while the
    robot waits.
    """

    @dataclass(frozen=True)
    class Options:
        """`rate`: probability per step that a trigger is tried; None: as the domain says."""

        rate: float | None = None

    sees: Sequence[Sight] = ("state", "robot_action")

    def __init__(self, game: Game, options: Options) -> None:
        """Raises ValueError, naming the scenarios there are, for an unknown one."""
        known = game.description.scenarios
        if game.scenario not in known:
            raise ValueError(f"no scenario {game.scenario}; there are {', '.join(known)}")
        self._triggers = [t for t in game.description.triggers if t.scenario == game.scenario]
        self._rate = options.rate
        self.reset(0)

    def reset(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self._fired = False

    def act(self, view: AdversaryView) -> Action:
        if self._fired or tuple(view.legal) == (NONE,):
            return NONE
        triggers = [t for t in self._triggers if t.upon in (None, view.robot_action)]
        if not self._tries(triggers):
            return NONE
        event = self._choose(triggers, view)
        self._fired = event != NONE
        return event

    def _tries(self, triggers: Sequence[Trigger]) -> bool:
        """The coin of a step. The triggers of a scenario that apply together share one."""
        if not triggers:
            return False
        probability = triggers[0].probability if self._rate is None else self._rate
        return probability >= 1 or bool(self._random.random() < probability)

    def _choose(self, triggers: Sequence[Trigger], view: AdversaryView) -> Action:
        draws = max(len(trigger.drawings) for trigger in triggers)
        for number in range(draws):
            triggers = self._drawn(number, triggers, view)
        events = dict.fromkeys(t.event for t in triggers if _possible(t, view))
        if not events:
            return NONE
        return self._draw(list(events)) if draws else next(iter(events))

    def _drawn(
        self, number: int, triggers: Sequence[Trigger], view: AdversaryView
    ) -> list[Trigger]:
        """The triggers with the value that is drawn, of the values of all of them.

        A value whose pool does not hold passes the draw on to the others of the same event.
        """
        values = dict.fromkeys(_value(t, number) for t in triggers)
        drawable = [t for t in triggers if _is_drawable(t, number, view)]
        pool = dict.fromkeys(_value(t, number) for t in drawable)
        if not pool:
            return []
        drawn = self._draw(list(values))
        if drawn not in pool:
            others = [value for value in pool if value[0] == drawn[0]]
            if not others:
                return []
            drawn = self._draw(others)
        return [t for t in drawable if _value(t, number) == drawn]

    def _draw(self, options: Sequence[T]) -> T:
        return options[int(self._random.integers(len(options)))]


class Script:
    """Plays given exogenous actions at given steps, or with given physical actions of the robot.

    An impossible entry is played all the same, and the environment refuses it and says why; or it
    is skipped. `skipped` are the entries that were due at the last step and were not played.
    """

    sees: Sequence[Sight] = ("robot_action",)

    def __init__(
        self,
        entries: Iterable[tuple[int, Action]],
        at_actions: Iterable[tuple[int, Action]] = (),
        skips: bool = False,
    ) -> None:
        """`entries` are steps, `at_actions` numbers of physical actions, from 1 on, with an action.

        `skips`: impossible entries are skipped. Raises ValueError for a step or a number twice.
        """
        self._at_steps, self._at_actions = _by_number(entries), _by_number(at_actions)
        self._skips = skips
        self.reset(0)

    def reset(self, seed: int) -> None:
        """A script draws nothing."""
        del seed
        self._physical = 0
        self.skipped: tuple[Action, ...] = ()

    def act(self, view: AdversaryView) -> Action:
        """Raises ValueError where two entries are due at a step and none may be skipped."""
        due = self._due(view)
        if len(due) > 1 and not self._skips:
            raise ValueError(f"script: at step {view.step} two entries are due: {', '.join(due)}")
        played = [event for event in due if not self._skips or event in view.legal][:1]
        self.skipped = tuple(event for event in due if event not in played)
        return next(iter(played), NONE)

    def _due(self, view: AdversaryView) -> list[Action]:
        due = [self._at_steps.get(view.step)]
        if view.physical:
            self._physical += 1
            due.append(self._at_actions.get(self._physical))
        return list(dict.fromkeys(event for event in due if event is not None))

    def unreached(self, step: int) -> list[str]:
        """The moments of entries that are not due before a step; after the steps before it."""
        steps = sorted(number for number in self._at_steps if number >= step)
        actions = sorted(number for number in self._at_actions if number > self._physical)
        return [f"step {n}" for n in steps] + [f"action {n} of the robot" for n in actions]


def _by_number(entries: Iterable[tuple[int, Action]]) -> dict[int, Action]:
    actions: dict[int, Action] = {}
    for number, action in entries:
        if number in actions:
            raise ValueError(f"script: step {number} has two actions: one per step is possible")
        actions[number] = action
    return actions


def _value(trigger: Trigger, number: int) -> tuple[str, str | None]:
    """What a draw is among: a kind of event with a value, None where it draws no further one."""
    drawn = trigger.drawings[number].value if number < len(trigger.drawings) else None
    return trigger.event.name, drawn


def _is_drawable(trigger: Trigger, number: int, view: AdversaryView) -> bool:
    return number >= len(trigger.drawings) or _hold(trigger.drawings[number].pool, view)


def _possible(trigger: Trigger, view: AdversaryView) -> bool:
    return trigger.event in view.legal and _hold(trigger.body, view)


def _hold(literals: Iterable[Literal], view: AdversaryView) -> bool:
    """Whether literals are true in the state; an agent action is where the robot attempts it."""
    return all(
        lit.is_positive == (lit.atom in view.state or lit.atom == view.robot_action)
        for lit in literals
    )
