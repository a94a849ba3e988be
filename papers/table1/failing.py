"""When the robots of a pair fail, and whether they met the same."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

from papers.markdown import markdown, paragraph
from papers.table1 import evidence
from papers.table1.evidence import Blindness
from papers.table1.runs import Run
from papers.text import percent
from testbed.studies.table1.load import MEETINGS, Pair
from testbed.studies.table1.measures import RANDOM
from testbed.studies.table1.published import PUBLISHED

COLUMNS = ("scenario", "goal undone", "TP right", "other pairs", "TP right")


def blindness(pairs: Sequence[Pair]) -> str:
    """When the traditional robot fails."""
    seen = {name: evidence.blindness(own) for name, own in _by_row(pairs).items()}
    return f"""\
## When TP fails

TP looks at nothing but the outcome of its own action. A book that it still has to fetch and does
not find makes an action fail; TP explains that and plans again. A book that was taken away from
where the goal wants it is part of no action of its plan any more. The pairs by whether the
exogenous action undid a part of the goal (a literal of the goal is false after it that would else
have been true):

{markdown(COLUMNS, _undone(seen))}

{_decided(seen.values())}
"""


def _undone(seen: Mapping[str, Blindness]) -> Iterator[tuple[str, ...]]:
    for name, own in seen.items():
        first = (str(own.undone), f"{own.undone_right} of {own.undone}")
        yield (name, *first, str(own.others), f"{own.others_right} of {own.others}")


def _decided(seen: Iterable[Blindness]) -> str:
    """What decides TP's accuracy, as far as it does in all of these pairs."""
    against = sum(own.undone_right + own.others - own.others_right for own in seen)
    if against:
        return paragraph(
            f"In {against} of these pairs TP is right although a part of the goal was undone, or "
            "wrong although none was: something else decides there."
        )
    lost = {row: percent(1 - PUBLISHED[row].baseline) for row in ("3", "4")}
    return paragraph(
        "TP's accuracy in a row is thus decided by the share of its pairs in which a part of the "
        "goal was undone, whatever else happens in them; of the published pairs "
        f"{lost['3']} in row 3 and {lost['4']} in row 4, if it was so there, too.",
    )


def _by_row(pairs: Sequence[Pair]) -> Mapping[str, list[Pair]]:
    groups: dict[str, list[Pair]] = {}
    for pair in pairs:
        drawn = pair.intended == RANDOM
        if drawn and pair.happened.isdigit():
            groups.setdefault(f"random, {pair.happened}", []).append(pair)
        elif not drawn and pair.mind.event is not None:
            groups.setdefault(f"triggered, {pair.intended}", []).append(pair)
    return dict(sorted(groups.items()))


def failures(run: Run, mind: str) -> str:
    """The trials that the intentional robot did not get right, each with its replay."""
    minds = [pair.mind for pair in run.pairs[mind]]
    wrong = [side for side in minds if side.decided and not side.correct]
    where = shlex.quote(f"runs/{run.config.name}")
    lines = [f"$ testbed replay {where} --trial {side.trial}  # {side.outcome}" for side in wrong]
    told = "\n".join(["", "```console", *lines, "```", ""]) if lines else ""
    return f"""\
## ATI's failures, with goal feedback

ATI was not correct in {len(wrong)} of {len(run.pairs[mind])} trials.
{told}"""


def meetings(pairs: Sequence[Pair]) -> str:
    """Whether the robots of a pair met the same event."""
    counts = Counter(pair.meeting for pair in pairs)
    rows = [(text, str(counts[name])) for name, text in MEETINGS.items()]
    return f"## Did both robots meet the same?\n\n{markdown(('pairs in which', 'number'), rows)}\n"
