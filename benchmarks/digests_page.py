"""The page of digests in the documents, from what was played."""

from __future__ import annotations

from collections.abc import Sequence

from benchmarks.sheets import Row, Sheet
from papers.markdown import markdown

COLUMNS = ("played", "trials", "failed", "digest")
EARLIER = {
    "table1": (
        "64c2731045ec63d0cc804d11f23fa5daf8368225835482e66838cc3426162354",
        "fbdac7fa7fa8126b23c04a326b2c4356406144823502789e363a04083996c6bb",
    ),
    "levels": (
        "e2df84ad3b63064ddea8c19e2277ab0340954bbff3b1fae5c4c860fefcb8fd6c",
        "ca14ecfded6b07c6f02eb6359b4c1080afcda61f826ce468a67c8e3f1ca51e81",
    ),
}
"""Of the published studies at revision 1f1b2891d49b: of whole records, and of their results."""
LINKS = {"inprocess": "in process", "zenoh": "over zenoh"}

HEAD = """# The same results however a run is played

The *digest* of a run is the SHA-256 of its results, whatever their order in the file.
`testbed run` and `testbed report` print it, and `summary.json` keeps it. It covers these fields of
each record, and no others: `seed` (which follows from the trial's seed path), `scenario`, `level`,
`robot`, `initial`, `goal`, `outcome`, `actions`, `exogenous`, `explanations` (step, unobserved
events, exceptions, distrusted reports), `mental`, `plans` (their number, and of each the step and
the actions), `execution_units`. Ids, settings, times, statistics and texts are left out, and so is
each field that records gain later. The number of workers, the link, and whether the run was
interrupted make no difference to it.

Here each protocol was played in four ways: with one worker and with two, with two that
each talk to a robot's process over zenoh, and with two whose driver was killed (SIGKILL) in the
middle, after which `--resume` played what was missing. {verdict}

```
{command}
```

The command exits with 1 where digests differ. A small size of it runs with the tests.
A digest is that of one revision of the program{revision}: a robot that acts, plans or explains
otherwise gives another one.

Until revision 1f1b2891d49b the digest covered whole records except their times. The same records
of both published studies have these digests:

{earlier}
"""


def page(sheets: Sequence[Sheet], overrides: Sequence[str]) -> str:
    """The page, in Markdown: a section a sheet, a row a way."""
    names = " ".join([*(sheet.name for sheet in sheets), *overrides])
    command = f"python -m benchmarks.digests {names} --page docs/digests.md"
    head = HEAD.format(
        verdict=_verdict(sheets), command=command, revision=_revision(sheets), earlier=_earlier()
    )
    return "\n".join([head, *(_section(sheet) for sheet in sheets)])


def _verdict(sheets: Sequence[Sheet]) -> str:
    differ = [sheet.name for sheet in sheets if len({row["digest"] for row in sheet.rows}) > 1]
    if differ:
        return f"**The results of {' and of '.join(differ)} differ.**"
    return "The digests of a protocol are equal."


def _revision(sheets: Sequence[Sheet]) -> str:
    found = sorted({str(row["revision"]) for sheet in sheets for row in sheet.rows})
    return "" if found == ["None"] else f", here {' and '.join(found)}"


def _earlier() -> str:
    rows = [(study, *(f"`{own}`" for own in digests)) for study, digests in EARLIER.items()]
    return markdown(("study", "whole records", "results"), rows)


def _section(sheet: Sheet) -> str:
    return f"## {sheet.title}\n\n{markdown(COLUMNS, map(_cells, sheet.rows))}\n"


def _cells(row: Row) -> tuple[str, ...]:
    return (_how(row), str(row["trials"]), str(row["failed"]), f"`{row['digest']}`")


def _how(row: Row) -> str:
    workers = "1 worker" if row["workers"] == 1 else f"{row['workers']} workers"
    how = f"{workers}, {LINKS[str(row['link'])]}"
    if row["killed_after"] is None:
        return how
    return f"{how}, killed with {row['killed_after']} trials on record, and resumed"
