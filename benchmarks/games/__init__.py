"""Random games with the robots, in which each decision is held against brute force.

`python -m benchmarks.games [N] [--seed S]` plays N games; a game follows from its seed alone.
"""

import sys
from collections.abc import Iterable

from benchmarks.games import fine
from benchmarks.games.drawing import draw
from benchmarks.games.playing import MakeRobot, Story, Tally, play, shortened
from benchmarks.sheets import DisagreementError, Sheet
from testbed.experiment.robots import make_robot

GAMES = {"small": 30, "full": 5_000}
_TOLD_EVERY = 250


def main(size: str) -> list[Sheet]:
    """Sheet `games`, with a row per robot. Raises DisagreementError, which has the stories."""
    tally = run(range(GAMES[size]))
    found = [*map(str, tally.found), *fine.found(range(fine.GAMES[size]))]
    if found:
        raise DisagreementError("\n\n".join(found))
    notes = (
        "each decision was held against brute force: belief, explanation, plan and reason;",
        f"so were the coarse ones of {fine.GAMES[size]} games at the fine resolution",
    )
    return [Sheet("games", "Random games", tally.rows, notes)]


def run(seeds: Iterable[int], make: MakeRobot = make_robot) -> Tally:
    """Plays the games of these seeds, with the shortest story of each fault that is found."""
    tally = Tally()
    for number, seed in enumerate(seeds, start=1):
        story = play(draw(seed), make)
        tally.add(story)
        if story.faults:
            tally.found.append(shortened(story, make))
            print(f"seed {seed}: {story.faults[0]}", file=sys.stderr, flush=True)
        if number % _TOLD_EVERY == 0:
            print(f"{number} games", file=sys.stderr, flush=True)
    return tally


__all__ = ["GAMES", "Story", "main", "run"]
