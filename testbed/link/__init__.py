"""The link between a driver and its robots: in process, or over zenoh between processes."""

from testbed.link.exchange import InProcessRobot as InProcessRobot
from testbed.link.exchange import understood as understood
from testbed.link.process import SpawnedRobot as SpawnedRobot
from testbed.link.process import connect as connect
from testbed.link.process import spawned_robot as spawned_robot
from testbed.link.remote import RemoteRobot as RemoteRobot
from testbed.link.serving import serve as serve
from testbed.link.serving import serve_forever as serve_forever
from testbed.link.session import endpoint as endpoint
from testbed.link.session import open_as_configured as open_as_configured
from testbed.link.session import open_driver as open_driver
from testbed.link.session import open_robot as open_robot
from testbed.link.session import open_waiting as open_waiting
