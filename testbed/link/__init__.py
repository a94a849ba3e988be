"""The link between a driver and its robots: in process, or over zenoh between processes."""

from testbed.link.exchange import InProcessRobot
from testbed.link.process import SpawnedRobot, connect, spawned_robot
from testbed.link.remote import RemoteRobot
from testbed.link.serving import serve, serve_forever
from testbed.link.session import endpoint, open_as_configured, open_driver, open_robot, open_waiting

__all__ = [
    "InProcessRobot",
    "RemoteRobot",
    "SpawnedRobot",
    "connect",
    "endpoint",
    "open_as_configured",
    "open_driver",
    "open_robot",
    "open_waiting",
    "serve",
    "serve_forever",
    "spawned_robot",
]
