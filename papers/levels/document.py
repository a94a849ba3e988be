"""`docs/levels-published-and-measured.md`: Tables 2 and 3 beside ours, and what explains them."""

from __future__ import annotations

from collections.abc import Iterator

from papers.commands import workers_of
from papers.levels import prose
from papers.levels.commands import commands
from papers.levels.differing import differences
from papers.levels.meeting import failures, meetings
from testbed.experiment.coverage import coverage_of
from testbed.experiment.digest import digest
from testbed.experiment.store import read_records
from testbed.studies.levels.published import FIRST, PAPER
from testbed.studies.levels.runs import Run
from testbed.studies.levels.table import (
    GROWTH,
    RATIOS,
    SECONDS,
    SHARES,
    TESTS,
    effect_rows,
    growth_rows,
    ratio_rows,
    seconds_rows,
    share_rows,
)
from testbed.text.markdown import markdown, paragraph

INTRODUCTION = """\
Generated from stored trials by the commands below; [the levels](levels.md) says what is played and
counted. Nothing in the robots or in the levels was chosen to come near the published figures.

```console
{commands}
```

Whoever runs the first command gets the same results: their digest is
`{digest}`. Times depend on the machine, and on
what else it does{workers}."""

READING = """\
What can be compared across machines and solvers are shares, ratios and growth. In their tables: our
value with its 95% interval, for times the mean and below it the median, and the published value,
with `*` where it does not lie in the interval of ours. *Fine* is reasoning in cells and parts,
*coarse* in rooms and objects, *all* both in a trial; *a refined plan* is the mean time of one.
Times are process time of the robot, its solver included, without what is prepared once and reused.
Beside the mean of ratios stands the ratio of sums (*of sums*), in which long trials weigh more."""

TESTING = """\
Effect sizes (of times rank-biserial, above 0 where zooming saves time; of trials that achieved
their goal, and of correct ones, the difference of the shares, above 0 where zooming has more), with
p-values after Holm's correction over the table. There is none where no pair differs."""


def document(run: Run) -> str:
    """The page as Markdown: the tables, why ours differ, what both robots met, the tests."""
    return prose.document(_parts(run))


def _parts(run: Run) -> Iterator[str]:
    yield "# The levels: published and measured"
    yield INTRODUCTION.format(
        commands=commands(run.folder, run.config),
        digest=digest(read_records(run.folder)),
        workers=_workers(run),
    )
    yield _incomplete(run)
    yield from _compared(run)
    yield "## Seconds"
    yield "Means and standard deviations, and our medians."
    yield markdown(SECONDS, seconds_rows(run.levels, PAPER))
    yield from differences(run)
    yield from meetings(run)
    yield from failures(run)
    yield "## Tests"
    yield TESTING
    yield markdown(TESTS, effect_rows(run.levels))


def _incomplete(run: Run) -> str:
    notice = coverage_of(read_records(run.folder), run.config).notice()
    return "" if notice is None else paragraph(f"**Incomplete:** {notice}.")


def _workers(run: Run) -> str:
    workers = workers_of(run.folder)
    if workers is None:
        return ""
    return (
        f"; these are of trials played by {workers} process{'es' if workers > 1 else ''} at a time"
    )


def _compared(run: Run) -> Iterator[str]:
    yield "## What can be compared"
    yield READING
    yield "**Trials that achieved their goal**, those in error or without their robot included:"
    yield markdown(SHARES, share_rows(run.levels, PAPER))
    yield "**No zoom / zoom**, over the pairs in which both robots achieved their goal:"
    yield markdown(RATIOS, ratio_rows(run.levels, PAPER))
    grown = list(growth_rows(run.levels, PAPER))
    if grown:
        yield f"**Growth**: how many times the mean (median) at {FIRST} in the same condition:"
        yield markdown(GROWTH, grown)
