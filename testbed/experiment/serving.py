"""Serve the registered robots over zenoh, in this process."""

import sys
from contextlib import suppress
from pathlib import Path

import zenoh

from testbed.experiment.errors import ServingError
from testbed.experiment.robots import make_robot, only
from testbed.link import open_as_configured, open_waiting, serve, serve_forever

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
    except zenoh.ZError as error:
        # What zenoh says, without the place in its source that it adds.
        said = (str(error).splitlines() or [type(error).__name__])[0].partition(" at /")[0]
        raise ServingError(f"{config or connect or USUAL}: {said}") from None
