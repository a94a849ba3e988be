"""The page of digests in the documents, from what was played."""

from __future__ import annotations

from collections.abc import Sequence

from benchmarks.sheets import Row, Sheet
from testbed.experiment.markdown import markdown

COLUMNS = ("played", "trials", "failed", "digest")
LINKS = {"inprocess": "in process", "zenoh": "over zenoh"}

HEAD = """# The same results however a run is played

The *digest* of a run is the SHA-256 of its records without their times, whatever their order in
the file. `testbed run` and `testbed report` print it, and `summary.json` keeps it. It depends on
the configuration and on the program; the number of workers, the link, and whether the run was
interrupted make no difference to it.

Here each protocol was played in four ways: with one worker and with two, with two that
each talk to a robot's process over zenoh, and with two whose driver was killed (SIGKILL) in the
middle, after which `--resume` played what was missing. {verdict}

```
{command}
```

The command exits with 1 where digests differ. A small size of it runs with the tests.
A digest is that of one revision of the program{revision}: a robot that plans otherwise, or says
more in a record, gives another one.
"""


def page(sheets: Sequence[Sheet], overrides: Sequence[str]) -> str:
    """The page, in Markdown: a section a sheet, a row a way."""
    names = " ".join([*(sheet.name for sheet in sheets), *overrides])
    command = f"python -m benchmarks.digests {names} --page docs/digests.md"
    head = HEAD.format(verdict=_verdict(sheets), command=command, revision=_revision(sheets))
    return "\n".join([head, *(_section(sheet) for sheet in sheets)])


def _verdict(sheets: Sequence[Sheet]) -> str:
    differ = [sheet.name for sheet in sheets if len({row["digest"] for row in sheet.rows}) > 1]
    if differ:
        return f"**The results of {' and of '.join(differ)} differ.**"
    return "The digests of a protocol are equal."


def _revision(sheets: Sequence[Sheet]) -> str:
    found = sorted({str(row["revision"]) for sheet in sheets for row in sheet.rows})
    return "" if found == ["None"] else f", here {' and '.join(found)}"


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
