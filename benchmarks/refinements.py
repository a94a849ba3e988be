"""Random refinements of random domains: each is refused with its place, or can be acted by."""

import re
from collections import Counter
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from benchmarks.own import Own
from benchmarks.own_trials import OwnTrial, random_trial
from benchmarks.sheets import Row, Sheet
from testbed.config import ConfigError

TRIALS = {"small": 20, "full": 2_000}
REFUSED, ACHIEVED, OUT_OF_REACH = "refused", "achieved", "out of reach"
FINE = (REFUSED, ACHIEVED, OUT_OF_REACH)
"""How a trial without chance and without an adversary may end."""

_GAVE_UP = "gave_up"
_PLACED = re.compile(r"\bown\.(al|fine):\d+:\d+: ")


def main(size: str) -> list[Sheet]:
    """Sheet `refinements`: how many of the trials end how; the numbers of those that fail."""
    ends: dict[tuple[str, bool], Counter[str]] = {}
    failed: list[str] = []
    with TemporaryDirectory() as folder:
        for number in range(TRIALS[size]):
            trial = random_trial(Random(number))
            end = verdict(trial, Path(folder))
            key = (" and ".join(trial.refined.magnified), trial.is_whole)
            ends.setdefault(key, Counter())[end if end in FINE else "failed"] += 1
            if end not in FINE:
                failed.append(f"trial {number}: {end}")
    rows = [_row(*key, found) for key, found in sorted(ends.items())]
    title = "Random refinements of random domains, a trial each"
    return [Sheet("refinements", title, rows, failed or ["none failed"])]


def _row(magnified: str, is_whole: bool, found: Counter[str]) -> Row:
    counts = {end.replace(" ", "_"): found[end] for end in (*FINE, "failed")}
    return {"magnified": magnified, "a_line_left_out": not is_whole, **counts}


def verdict(trial: OwnTrial, folder: Path) -> str:
    """How a trial ends: one of FINE, or what went wrong.

    A goal is out of reach where the robot says so at either resolution.
    """
    refined = trial.refined
    outcome = _played(Own(folder, refined.domain.text, refined.text), trial, trial.fine)
    if outcome != _GAVE_UP:
        return outcome
    coarse = _played(Own(folder, refined.domain.text), trial, trial.coarse)
    return OUT_OF_REACH if coarse == _GAVE_UP else f"{outcome}, at the coarse resolution {coarse}"


def _played(own: Own, trial: OwnTrial, initial: tuple[str, ...]) -> str:
    keys = {"goal": list(trial.goal), "initial": list(initial), "robots": ["intentional"]}
    try:
        ((record, _),) = own.play(**keys, limits={"steps": 100})
    except ConfigError as error:
        placed = all(map(_PLACED.search, str(error).splitlines()))
        return REFUSED if placed else f"refused without a place: {error}"
    return f"error: {record.reason}" if record.outcome == "error" else record.outcome
