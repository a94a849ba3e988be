"""Compare robots, conditions or runs."""

from typing import Annotated

import typer

from testbed.cli.common import Folders, examples, input_errors, say

EPILOG = examples(
    "testbed compare runs/quickstart",
    "testbed compare runs/office runs/office-2",
    "testbed compare runs/rate --baseline 'adversary.rate=0.5 / traditional' "
    "--treatment 'adversary.rate=0.5 / intentional'",
)


def command(
    folders: Folders,
    baseline: Annotated[
        str | None, typer.Option(help="What others are compared with; without it the first.")
    ] = None,
    treatment: Annotated[
        str | None, typer.Option(help="What is compared with it; without it every other one.")
    ] = None,
) -> None:
    """Compare robots, conditions of a sweep, or runs, over trials from the same starts and seeds.

    Each line has the share of trials that achieve the goal, with a 95% interval, and what the
    baseline needed divided by what the treatment did, over the pairs in which both achieve it. In
    brackets: the effect, and p after Holm's correction over all tests.
    """
    with input_errors():
        from testbed.analysis import load_run
        from testbed.analysis.contestants import contrasts
        from testbed.report.contrasts import grid
        from testbed.text import columns

        found = contrasts([load_run(folder) for folder in folders], baseline, treatment)
        for line in grid(found).lines(columns()):
            say(line)
