"""Serve the registered robots over zenoh, in this process."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import zenoh

from testbed.experiment.errors import ServingError
from testbed.experiment.registry import make_robot
from testbed.link.serve import serve, serve_forever


def serve_robot(connect: str | None, name: str, config: Path | None) -> None:
    """Serve under `name` until interrupted.

    `connect` is the endpoint of a driver, with which the robot ends, or of a router. `config` is a
    zenoh configuration, which then says everything about the session.

    Raises:
        ServingError: where neither or both are given, or zenoh cannot open the session.
    """
    if (connect is None) == (config is None):
        raise ServingError("give either --connect ENDPOINT or --config FILE")
    try:
        if connect is not None:
            serve_forever(connect, name, make_robot)
        else:
            _serve_configured(name, str(config))
    except zenoh.ZError as error:
        raise ServingError(f"{connect or config}: {_first_line(error)}") from None


def _serve_configured(name: str, config: str) -> None:
    with zenoh.open(zenoh.Config.from_file(config)) as session, suppress(KeyboardInterrupt):
        serve(session, name, make_robot)


def _first_line(error: Exception) -> str:
    """What zenoh says, without the place in its source that it adds."""
    line = (str(error).splitlines() or [type(error).__name__])[0]
    return line.partition(" at /")[0]
