"""Make a run's report again."""

from testbed.cli.common import Folders, examples, input_errors

EPILOG = examples("testbed report runs/quickstart")


def command(folders: Folders) -> None:
    """Make tables, summary.json and report.html again from the stored trials."""
    from testbed.experiment.run_folder import read_config

    with input_errors():
        from testbed.cli.loading import search_beside

        configs = [read_config(folder) for folder in folders]
        from testbed.cli.session import report_again

        for folder, config in zip(folders, configs, strict=True):
            search_beside(folder / "config.yaml")  # where a study of one's own lies
            report_again(folder, config)
