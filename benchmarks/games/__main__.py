"""`python -m benchmarks.games [N] [--seed S]`"""

import argparse
import sys
from collections.abc import Sequence

from benchmarks import games


def main(arguments: Sequence[str] | None = None) -> int:
    """Plays N games, of the seeds S, S + 1, ...; prints each fault with its seed and its story.

    The exit code: 0 nothing found, 1 found, 2 bad input.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.games", description=__doc__)
    parser.add_argument("number", nargs="?", type=int, default=games.GAMES["full"], metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="S")
    given = parser.parse_args(arguments)
    if given.number < 1:
        parser.error(f"N: {given.number} is no number of games; at least 1")
    seeds = range(given.seed, given.seed + given.number)
    tally = games.run(seeds)
    for story in tally.found:
        print(story)
    print(f"seeds {seeds[0]} to {seeds[-1]}: {tally}")
    return 1 if tally.found else 0


if __name__ == "__main__":
    sys.exit(main())
