"""Serve the registered robots over zenoh, in this process."""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path

import zenoh

from testbed.experiment.errors import ServingError
from testbed.experiment.robots import make_robot, only
from testbed.link import open_as_configured, open_waiting, serve, serve_forever
from testbed.protocol import RobotFactory

USUAL = "tcp/127.0.0.1:7447"
"""Where a router of zenoh listens unless told otherwise."""


def serve_robot(connect: str | None, name: str, config: Path | None) -> None:
    """Serve under `name` until interrupted; a name `module:Class` serves that robot alone.

    `connect` is the endpoint of a driver, with which the robot ends, or of a router. `config` is a
    zenoh configuration, which says everything about the session, but for `connect` where both are
    given. Without either the robot serves at the usual endpoint whenever somebody is there.

    Raises:
        ServingError: where zenoh cannot open the session.
        RegistryError: where there is no such robot.
    """
    robots = only(name) if ":" in name else make_robot
    try:
        if config is not None:
            _serve(open_as_configured(config, connect), name, robots)
        elif connect is not None:
            serve_forever(connect, name, robots)
        else:
            print(f"robot '{name}' serves whoever listens at {USUAL}", file=sys.stderr, flush=True)
            _serve(open_waiting(USUAL), name, robots)
    except zenoh.ZError as error:
        raise ServingError(f"{config or connect or USUAL}: {_first_line(error)}") from None


def _serve(session: zenoh.Session, name: str, robots: RobotFactory) -> None:
    with session, suppress(KeyboardInterrupt):
        serve(session, name, robots)


def _first_line(error: Exception) -> str:
    """What zenoh says, without the place in its source that it adds."""
    line = (str(error).splitlines() or [type(error).__name__])[0]
    return line.partition(" at /")[0]
