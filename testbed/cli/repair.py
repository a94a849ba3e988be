"""Repair a run folder."""

from testbed.cli.common import Folder, examples, input_errors, say

EPILOG = examples("testbed repair runs/quickstart")


def command(folder: Folder) -> None:
    """Keep what is whole of a damaged run, and say what is dropped.

    Lines of trials.jsonl that are torn, no records, repeated, or of no trial of the run are
    dropped; the old file is kept as trials.jsonl.damaged. What is missing then is played by
    `testbed run DIR/config.yaml --out DIR --resume`.
    """
    with input_errors():
        from testbed.experiment.repair import repair

        repair(folder, say)
