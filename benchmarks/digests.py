"""The same results however a run is played: with more workers, over zenoh, killed and resumed.

`python -m benchmarks.digests CONFIG ... [KEY=VALUE ...] [--folder DIR] [--page FILE.md]`
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from benchmarks.digests_page import page
from benchmarks.killing import killed_at
from benchmarks.sheets import Row, Sheet, gathered, show
from testbed.cli.loading import load
from testbed.config import ConfigError
from testbed.experiment.digest import digest
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import FAILURES
from testbed.experiment.run_folder import PROVENANCE
from testbed.experiment.store import read_records

SAME, DIFFERENT, BAD_INPUT = 0, 1, 2
WIDE = 160
COMMAND = (sys.executable, "-m", "testbed")


@dataclass(frozen=True)
class Way:
    """How a run is played; `killed` in the middle, its driver is started again."""

    name: str
    workers: int
    link: str
    killed: bool = False


WAYS = (
    Way("one", 1, "inprocess"),
    Way("two", 2, "inprocess"),
    Way("zenoh", 2, "zenoh"),
    Way("killed", 2, "inprocess", killed=True),
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Play each configuration in each way, and tell the digests.

    The exit code: 0 where each configuration has one digest, 1 where one has several, 2 for a
    configuration that is not valid and for a folder that is not empty.
    """
    given = _parser().parse_args(arguments)
    overrides = [item for item in given.items if "=" in item]
    configs = [item for item in given.items if "=" not in item] or ["table1", "levels"]
    with ExitStack() as stack:
        folder = given.folder or Path(stack.enter_context(tempfile.TemporaryDirectory()))
        try:
            sheets = [_sheet(config, overrides, folder) for config in configs]
        except (ConfigError, FileExistsError) as error:
            print(error, file=sys.stderr)
            return BAD_INPUT
    _tell(sheets)
    if given.page is not None:
        given.page.write_text(page(sheets, overrides), encoding="utf-8")
    return SAME if all(len(digests_of(sheet)) == 1 for sheet in sheets) else DIFFERENT


def digests_of(sheet: Sheet) -> set[str]:
    """The digests of a sheet's rows: one, if the ways agree."""
    return {str(row["digest"]) for row in sheet.rows}


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.digests", description=__doc__)
    parser.add_argument("items", nargs="*", metavar="CONFIG|KEY=VALUE")
    parser.add_argument("--folder", type=Path, metavar="DIR", help="Keep the runs here.")
    parser.add_argument("--page", type=Path, metavar="FILE", help="Write the page about them here.")
    return parser


def _sheet(config: str, overrides: Sequence[str], folder: Path) -> Sheet:
    planned = len(plan_trials(load(config, overrides)))
    name = Path(config).stem
    return Sheet(name, name, gathered(_rows(config, overrides, folder / name, planned)))


def _rows(config: str, overrides: Sequence[str], folder: Path, planned: int) -> Iterator[Row]:
    for way in WAYS:
        print(f"{config}: {way.name}", file=sys.stderr, flush=True)
        _make(folder / way.name)
        yield _played(way, [config, *overrides], folder / way.name, planned)


def _make(folder: Path) -> None:
    """Make the folder of a run. Raises FileExistsError, in words, where there is one."""
    if folder.exists():
        raise FileExistsError(f"{folder}: is there already; choose another --folder")
    folder.mkdir(parents=True)


def _played(way: Way, what: Sequence[str], folder: Path, planned: int) -> Row:
    """Play a run in one way; its row."""
    arguments = ["run", *what, f"link={way.link}", "--workers", str(way.workers)]
    arguments += ["--out", str(folder)]
    began = time.perf_counter()
    kept = killed_at(planned // 2, arguments, folder).count(b"\n") if way.killed else None
    subprocess.run([*COMMAND, *arguments, "--resume"], check=False, stdout=subprocess.DEVNULL)
    records = list(read_records(folder))
    return {
        "workers": way.workers,
        "link": way.link,
        "killed_after": kept,
        "trials": len(records),
        "failed": sum(record.outcome in FAILURES for record in records),
        "minutes": (time.perf_counter() - began) / 60,
        "revision": _revision(folder),
        "digest": digest(records),
    }


def _revision(folder: Path) -> str | None:
    """The beginning of the revision that a run was played at; None outside of a checkout."""
    revision = json.loads((folder / PROVENANCE).read_text(encoding="utf-8"))["revision"]
    return None if revision is None else str(revision["commit"])[:12]


def _tell(sheets: Sequence[Sheet]) -> None:
    console = Console()
    console = console if console.is_terminal else Console(width=WIDE)
    for sheet in sheets:
        show(sheet, console)
        several = len(digests_of(sheet))
        verdict = "one digest" if several == 1 else f"{several} digests: the results differ"
        console.print(f"{sheet.name}: {verdict}", highlight=False)


if __name__ == "__main__":
    raise SystemExit(main())
