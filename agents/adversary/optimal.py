"""An adversary that plays the best of all that its budget allows, which it has rehearsed."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal as Choice

from agents.adversary.base import AdversaryView, Events, Game, Rehearsal, Rehearsed, Sight
from asp.language import Action
from testbed.protocol import NONE


class Optimal:
    """Plays the trial beforehand with every sequence of events within the budget.

    It takes the one that is worth most, of equals the one with the fewest events, then the earliest
    ones. This is exact where neither the robot nor the world leaves anything to chance.
    """

    @dataclass(frozen=True)
    class Options:
        """`measure`: the robot's execution units, or a failure before those.

        At most `episodes` are rehearsed; where that does not suffice, the best of them is taken.
        Raises ValueError for none.
        """

        measure: Choice["units", "fail"] = "units"
        episodes: int = 100_000

        def __post_init__(self) -> None:
            if self.episodes < 1:
                raise ValueError(f"episodes: {self.episodes} is none; 1 is the least")

    sees: Sequence[Sight] = ()
    needs_budget = True

    def __init__(self, game: Game, options: Options) -> None:
        """Raises ValueError without a budget, or a robot to rehearse with."""
        if game.rules.budget is None:
            raise ValueError("this adversary needs a budget; give adversary.budget")
        if game.rehearsal is None:
            raise ValueError("this adversary needs a robot to rehearse with, and here is none")
        self._budget, self._rehearsal, self._options = game.rules.budget, game.rehearsal, options
        self.reset(0)

    def reset(self, seed: int) -> None:
        """Begins a trial; nothing is drawn."""
        del seed
        self._plan: dict[int, Action] | None = None

    def act(self, view: AdversaryView) -> Action:
        """The event of the best sequence at this step, if it is legal."""
        if self._plan is None:
            self._plan = dict(best(self._rehearsal, self._budget, self._options)[0])
        event = self._plan.get(view.step, NONE)
        return event if event in view.legal else NONE


def best(rehearsal: Rehearsal, budget: int, options: Optimal.Options) -> tuple[Events, bool]:
    """The best events, and whether all sequences were rehearsed."""
    first = rehearsal.episode(())
    chosen, played, open_ = first, 1, [first.events]
    for _ in range(budget):
        behind: list[Events] = []
        for events in open_:
            for episode in rehearsal.branches(events, [*rehearsal.additions(events)]):
                if played >= options.episodes:
                    return chosen.events, False
                played += 1
                behind.append(episode.events)
                if _worth(episode, options) > _worth(chosen, options):
                    chosen = episode
        open_ = behind
    return chosen.events, True


def _worth(episode: Rehearsed, options: Optimal.Options) -> tuple[bool, int]:
    return options.measure == "fail" and not episode.achieved, episode.units
