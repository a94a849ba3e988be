"""A driver that is held as in `benchmarks.killing`, with little ahead of what is on record.

Its tasks have one pair each, and as many trials at most are ahead as lie between two numbers at
which it is held. However few trials a run has, those before the next number are thus left to
workers that play after the first.
"""

import sys
from itertools import pairwise

from benchmarks import killing
from testbed.experiment import dask_pool

COMMAND = (sys.executable, "-m", "benchmarks.fragile_driver")


def main() -> None:
    """The command line of `benchmarks.killing`, for a run on a cluster."""
    held = sorted(killing.numbers(sys.argv[1]))
    gaps = [late - early for early, late in pairwise(held)]
    dask_pool.TASK_S = 0.0
    dask_pool.AHEAD = min(gaps, default=dask_pool.AHEAD)  # type: ignore[attr-defined]
    killing.main()


if __name__ == "__main__":
    main()
