"""Random descriptions: in each of them all ways of reasoning agree with the definition."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.descriptions.case import Case
from benchmarks.descriptions.histories import check_explanations, check_histories
from benchmarks.descriptions.lives import check_lives
from benchmarks.descriptions.transitions import check_diagram, check_plans, check_qualifications
from benchmarks.sheets import DisagreementError, Row, Sheet

DESCRIPTIONS = {"small": 10, "full": 2_000}
REFUSED, AGREED, LEFT_OUT = "refused", "agreed", "left out"

CHECKS: Mapping[str, Callable[[Case], None]] = {
    "transitions": check_diagram,
    "qualifications": check_qualifications,
    "plans": check_plans,
    "explanations": check_explanations,
    "growing histories": check_histories,
    "lives": check_lives,
}


def main(size: str) -> list[Sheet]:
    """Sheet `equality`: what came of each check. Raises DisagreementError, with the seeds."""
    found: dict[str, Counter[str]] = {name: Counter() for name in CHECKS}
    failed: list[str] = []
    with TemporaryDirectory() as folder:
        for seed in range(DESCRIPTIONS[size]):
            for name, verdict in verdicts(seed, Path(folder)):
                known = verdict in (REFUSED, AGREED, LEFT_OUT)
                found[name][verdict if known else "failed"] += 1
                failed += [] if known else [f"{name} of {seed}: {verdict}"]
    if failed:
        raise DisagreementError("; ".join(failed))
    rows = [_row(name, counts) for name, counts in found.items()]
    title = "Random descriptions, each held against the definition"
    return [Sheet("equality", title, rows)]


def _row(check: str, counts: Counter[str]) -> Row:
    ends = (AGREED, LEFT_OUT, REFUSED)
    return {"check": check, **{end.replace(" ", "_"): counts[end] for end in ends}}


def verdicts(seed: int, folder: Path) -> Iterator[tuple[str, str]]:
    """What comes of each check of the description of a seed: one of three words, or a fault."""
    case = Case.of(seed, folder)
    for name, check in CHECKS.items():
        try:
            yield name, _verdict(case, check)
        except Exception as error:  # whatever it is, the other checks go on
            yield name, f"{type(error).__name__}: {error}"


def _verdict(case: Case, check: Callable[[Case], None]) -> str:
    if not case.is_of_the_language:
        return REFUSED
    if check not in (check_diagram, check_qualifications) and not case.definition.initial:
        return LEFT_OUT
    check(case)
    return AGREED
