"""Write a run's trials for other programs."""

from testbed.cli.common import Folders, examples, input_errors, say

EPILOG = examples("testbed export runs/quickstart")


def command(folders: Folders) -> None:
    """Write the stored trials of a run as trials.parquet and trials.csv into its folder."""
    from testbed.experiment.run_folder import read_config

    with input_errors():
        for folder in folders:
            read_config(folder)
        from testbed.analysis.export import export as write

        for folder in folders:
            for path in write(folder):
                say(str(path))
