"""Serve a robot over zenoh."""

import sys
from contextlib import suppress
from pathlib import Path
from typing import Annotated

import typer

from testbed.cli.common import examples, input_errors, refuse

EPILOG = examples(
    "testbed robot",
    "testbed robot --name arm --connect tcp/192.168.0.7:7447",
    "testbed robot --name my_package:MyRobot",
    "testbed robot --config zenoh.json5",
)

USUAL = "tcp/127.0.0.1:7447"
"""Where a router of zenoh listens unless told otherwise."""


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
    import zenoh

    from testbed.registry import search_as_told, search_last

    search_as_told()
    if ":" in name:
        search_last(Path.cwd())
    with input_errors():
        try:
            _serve(connect, name, config)
        except zenoh.ZError as error:
            # What zenoh says, without the place in its source that it adds.
            said = (str(error).splitlines() or [type(error).__name__])[0].partition(" at /")[0]
            refuse([f"{config or connect or USUAL}: {said}"])


def _serve(connect: str | None, name: str, config: Path | None) -> None:
    """Serve under `name` until interrupted; a name `module:Class` serves that robot alone.

    `connect` is the endpoint of a driver, with which the robot ends, or of a router. `config` is a
    zenoh configuration, which says everything about the session, but for `connect` where both are
    given. Without either the robot serves at the usual endpoint whenever somebody is there.
    """
    from testbed.experiment.robots import make_robot, only
    from testbed.link import open_as_configured, open_waiting, serve, serve_forever

    robots = only(name) if ":" in name else make_robot
    if config is None and connect is not None:
        serve_forever(connect, name, robots)
        return
    if config is not None:
        session = open_as_configured(config, connect)
    else:
        print(f"robot '{name}' serves whoever listens at {USUAL}", file=sys.stderr, flush=True)
        session = open_waiting(USUAL)
    with session, suppress(KeyboardInterrupt):
        serve(session, name, robots)
