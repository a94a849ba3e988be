"""A robot's process: answers questions over zenoh until its driver is gone."""

import os
import traceback
from contextlib import ExitStack, suppress

import zenoh

from testbed.link import keys
from testbed.link.exchange import Desk
from testbed.link.session import open_robot
from testbed.protocol import RobotFactory, in_one_line


def serve_forever(connect: str, name: str, make_robot: RobotFactory) -> None:
    """Serve a robot under ``name`` at the endpoint of a driver or router, until interrupted.

    The process ends as soon as the endpoint is gone. Raises zenoh.ZError when nobody listens there.
    """
    with (
        open_robot(connect) as session,
        session.info.declare_transport_events_listener(_leave_when_closed, history=True),
    ):
        if not session.info.transports():
            _leave()
        with suppress(KeyboardInterrupt):
            serve(session, name, make_robot)


def serve(session: zenoh.Session, name: str, make_robot: RobotFactory) -> None:
    """Answer questions in this thread, one after the other, until interrupted.

    Those addressed to ``name``, of any run, are answered, with the error if there is one. A
    liveliness token is declared while the robot is in a trial.
    """
    desk, addressees, liveliness = Desk(make_robot), (None, keys.chunk(name)), session.liveliness()
    trial, presence = "", ExitStack()
    with (
        presence,
        session.declare_queryable(keys.acts()) as queryable,
        # Declared last: whoever sees the token finds the queryable in place.
        liveliness.declare_token(keys.robot(name)),
    ):
        for query in queryable:
            with query:
                if query.parameters.get(keys.ADDRESSEE) not in addressees:
                    continue
                key = str(query.key_expr)
                try:
                    if key != trial:
                        presence.close()
                        presence.enter_context(liveliness.declare_token(keys.alive(key)))
                        trial = key
                    answer = desk.answer(bytes(query.payload or b""))
                    query.reply(key, answer)
                    session.put(keys.trace(key), answer)
                except Exception as error:
                    traceback.print_exc()
                    query.reply_err(in_one_line(error))


def _leave_when_closed(event: zenoh.TransportEvent) -> None:
    if event.kind == zenoh.SampleKind.DELETE:
        _leave()


def _leave() -> None:
    # The main thread may be deep in a search, and nobody is left to tell or to save for.
    os._exit(0)
