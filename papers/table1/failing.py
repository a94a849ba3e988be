"""When the robots of a pair fail, and whether they met the same."""

import shlex
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from papers.table1 import evidence
from papers.table1.evidence import Blindness
from papers.table1.pairs import Pair
from papers.table1.runs import Run
from papers.text import render
from testbed.studies.table1.measures import RANDOM
from testbed.studies.table1.pairs import MEETINGS
from testbed.studies.table1.published import PUBLISHED


def blindness(pairs: Sequence[Pair]) -> str:
    """When the traditional robot fails, and what decides that, as far as it does in these pairs."""
    seen = {name: evidence.blindness(own) for name, own in by_row(pairs).items()}
    return render(
        "table1/blindness",
        rows=list(_undone(seen)),
        against=sum(own.undone_right + own.others - own.others_right for own in seen.values()),
        lost={row: 1 - PUBLISHED[row].baseline for row in ("3", "4")},
    )


def _undone(seen: Mapping[str, Blindness]) -> Iterator[tuple[str, ...]]:
    for name, own in seen.items():
        first = (str(own.undone), f"{own.undone_right} of {own.undone}")
        yield (name, *first, str(own.others), f"{own.others_right} of {own.others}")


def by_row(pairs: Sequence[Pair]) -> Mapping[str, list[Pair]]:
    """The pairs of each row, by the table and the scenario."""
    groups: dict[str, list[Pair]] = {}
    for pair in pairs:
        drawn = pair.intended == RANDOM
        if drawn and pair.happened.isdigit():
            groups.setdefault(f"random, {pair.happened}", []).append(pair)
        elif not drawn and pair.treatment.event is not None:
            groups.setdefault(f"triggered, {pair.intended}", []).append(pair)
    return dict(sorted(groups.items()))


def failures(run: Run, mind: str) -> str:
    """The trials that the intentional robot did not get right, each with its replay."""
    minds = [pair.treatment for pair in run.pairs[mind]]
    return render(
        "table1/failures",
        wrong=[side for side in minds if side.decided and not side.correct],
        trials=len(minds),
        place=shlex.quote(f"runs/{run.config.name}"),
    )


def meetings(pairs: Sequence[Pair]) -> str:
    """Whether the robots of a pair met the same event."""
    counts = Counter(pair.meeting for pair in pairs)
    rows = [(text, str(counts[name])) for name, text in MEETINGS.items()]
    return render("table1/meetings", rows=rows)
