"""Serve a robot over zenoh."""

from pathlib import Path
from typing import Annotated

import typer

from testbed.cli.common import examples, input_errors

EPILOG = examples(
    "testbed robot",
    "testbed robot --name arm --connect tcp/192.168.0.7:7447",
    "testbed robot --name my_package:MyRobot",
    "testbed robot --config zenoh.json5",
)


def command(
    connect: Annotated[
        str | None,
        typer.Option(
            metavar="ENDPOINT",
            help="Driver or router to serve; the robot ends with it. Without this and --config: "
            "whoever listens at tcp/127.0.0.1:7447, zenoh's usual endpoint, now or later.",
        ),
    ] = None,
    name: Annotated[
        str,
        typer.Option(
            help="Name under which the robot offers itself; module:Class: that robot alone, whose "
            "module may lie in the working directory."
        ),
    ] = "robot",
    config: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="zenoh configuration, JSON5; --connect adds an endpoint to it."
        ),
    ] = None,
) -> None:
    """Serve a robot over zenoh until interrupted."""
    from testbed.experiment.serving import serve_robot
    from testbed.registry import search_as_told, search_last

    search_as_told()
    if ":" in name:
        search_last(Path.cwd())
    with input_errors():
        serve_robot(connect, name, config)
