"""The page of digests in the documents, from what was played."""

from collections.abc import Sequence

from benchmarks.sheets import Row, Sheet
from papers.text import render

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


def page(sheets: Sequence[Sheet], overrides: Sequence[str]) -> str:
    """The page, in Markdown: a section per sheet, a row per way."""
    return render(
        "digests",
        differ=[own.name for own in sheets if len({row["digest"] for row in own.rows}) > 1],
        names=[*(own.name for own in sheets), *overrides],
        revisions=sorted({str(row["revision"]) for own in sheets for row in own.rows}),
        earlier=[(study, *(f"`{own}`" for own in digests)) for study, digests in EARLIER.items()],
        sheets=[(own.title, list(map(_cells, own.rows))) for own in sheets],
    )


def _cells(row: Row) -> tuple[str, ...]:
    return (_how(row), str(row["trials"]), str(row["failed"]), f"`{row['digest']}`")


def _how(row: Row) -> str:
    workers = "1 worker" if row["workers"] == 1 else f"{row['workers']} workers"
    how = f"{workers}, {LINKS[str(row['link'])]}"
    if row["killed_after"] is None:
        return how
    return f"{how}, killed with {row['killed_after']} trials on record, and resumed"
