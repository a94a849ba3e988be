"""Make a run's report again, and serve it."""

from typing import Annotated

import typer

from testbed.cli.common import Folders, examples, input_errors, refuse

EPILOG = examples("testbed report runs/quickstart", "testbed report --serve runs/quickstart")
Serve = Annotated[
    bool,
    typer.Option("--serve", help="Then serve it to browsers of this machine, with all trials."),
]
Port = Annotated[
    int | None,
    typer.Option(min=1, max=65535, help="Where it is served. [default: one that is free]"),
]


def command(folders: Folders, serve: Serve = False, port: Port = None) -> None:
    """Make tables, summary.json and report.html again from the stored trials."""
    from testbed.experiment.run_folder import read_config

    if port is not None and not serve:
        refuse(["--port: is about where a report is served; add --serve"])
    with input_errors():
        from testbed.cli.loading import search_beside

        configs = [read_config(folder) for folder in folders]
        from testbed.cli.session import report_again, serve_reports

        reports = []
        for folder, config in zip(folders, configs, strict=True):
            search_beside(folder / "config.yaml")  # where a study of one's own lies
            report = report_again(folder, config)
            reports += [report] if serve else []
        if serve:
            serve_reports(reports, port or 0)
