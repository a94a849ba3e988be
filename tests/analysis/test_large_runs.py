"""Memory of commands about a run: of many records they hold few at a time."""

import subprocess
import sys
from pathlib import Path

from asp.language import Literal
from testbed.experiment.record import At
from testbed.experiment.run_folder import TRIALS, write_config
from testbed.experiment.store import encode
from tests.experiment.samples import Configure, a_record

PEAK = """
import resource, sys
from testbed.cli import app
try:
    app(sys.argv[1:])
except SystemExit as end:
    assert not end.code, end.code
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""
FEW, MANY, STEPS = 500, 10_500, 20
MOST_MB = 100
"""Of 10,000 more records. As Python objects, or as JSON text in memory, they have more."""


def _peak_mb(folder: Path, records: int, configure: Configure) -> int:
    folder.mkdir()
    write_config(folder, configure())
    events = [At(step, Literal.parse("shift")) for step in range(STEPS)]
    with (folder / TRIALS).open("wb") as file:
        file.writelines(encode(a_record(f"t{n}", mental=events)) for n in range(records))
    command = [sys.executable, "-c", PEAK, "export", str(folder)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return int(done.stdout.splitlines()[-1])


def test_the_memory_of_an_export_hardly_grows_with_the_run(
    tmp_path: Path, configure: Configure
) -> None:
    few = _peak_mb(tmp_path / "few", FEW, configure)
    assert _peak_mb(tmp_path / "many", MANY, configure) - few < MOST_MB
