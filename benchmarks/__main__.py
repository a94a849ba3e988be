"""`python -m benchmarks [NAME ...] [--size small|full] [--out DIR]`"""

import argparse
import time
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

try:
    from benchmarks.registry import BENCHMARKS, FIGURES, SIZES
    from benchmarks.sheets import show, write
except ModuleNotFoundError as missing:
    if missing.name in ("benchmarks", "tests"):
        raise
    raise SystemExit(f"no module {missing.name!r}; `make bench` installs what is needed") from None

RESULTS = Path(__file__).parent / "results"
WIDE = 140


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the named benchmarks, or all; prints tables and writes DIR/NAME.json."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(BENCHMARKS))
    parser.add_argument("--size", choices=SIZES, default="full")
    parser.add_argument("--out", type=Path, default=RESULTS, metavar="DIR")
    given = parser.parse_args(arguments)
    unknown = [name for name in given.names if name not in BENCHMARKS]
    if unknown:
        parser.error(f"unknown: {', '.join(unknown)}; there are {', '.join(BENCHMARKS)}")
    console = Console()
    console = console if console.is_terminal else Console(width=WIDE)
    for name in given.names or BENCHMARKS:
        _run(name, given.size, given.out, console)


def _run(name: str, size: str, out: Path, console: Console) -> None:
    began = time.perf_counter()
    sheets = BENCHMARKS[name](size)
    seconds = time.perf_counter() - began
    for sheet in sheets:
        show(sheet, console)
    path = out / f"{name}.json"
    write(sheets, path, size, seconds)
    if name in FIGURES:
        FIGURES[name](sheets, path.with_suffix(".png"))
    console.print(f"{name}: {seconds:.0f} s, {path}", highlight=False)


if __name__ == "__main__":
    main()
