"""A robot's process: answers questions over zenoh until its driver is gone."""

import os
import traceback
from contextlib import ExitStack, closing, suppress

import zenoh

from testbed.link import keys
from testbed.link.exchange import Desk
from testbed.link.session import open_robot
from testbed.protocol import RobotFactory, in_one_line


def serve_forever(
    connect: str, name: str, make_robot: RobotFactory, run: str | None = None
) -> None:
    """Serve a robot under ``name`` at the endpoint of a driver or router, until interrupted.

    Answers the questions of ``run``, or of any run (None), that are addressed to ``name``. The
    process ends as soon as the endpoint is gone. Raises zenoh.ZError when nobody listens there.
    """
    with (
        open_robot(connect) as session,
        session.info.declare_transport_events_listener(_leave_when_closed, history=True),
    ):
        if not session.info.transports():
            _leave()
        with suppress(KeyboardInterrupt):
            serve(session, name, make_robot, run)


def serve(
    session: zenoh.Session, name: str, make_robot: RobotFactory, run: str | None = None
) -> None:
    """Answer questions in this thread, one after the other, until interrupted."""
    post = _Post(session, name, make_robot)
    with (
        closing(post),
        session.declare_queryable(keys.acts(run)) as queryable,
        # Declared last: whoever sees the token finds the queryable in place.
        session.liveliness().declare_token(keys.robot(name)),
    ):
        for query in queryable:
            with query:
                post.handle(query)


class _Post:
    """Carries questions from zenoh to the desk and decisions back, and says in which trial."""

    def __init__(self, session: zenoh.Session, name: str, make_robot: RobotFactory) -> None:
        self._session = session
        self._addressee = keys.chunk(name)
        self._desk = Desk(make_robot)
        self._key = ""
        self._presence = ExitStack()

    def close(self) -> None:
        """Be in no trial any more."""
        self._presence.close()

    def handle(self, query: zenoh.Query) -> None:
        """Answer a question to this robot, with the error if there is one; leave others' alone."""
        if query.parameters.get(keys.ADDRESSEE) not in (None, self._addressee):
            return
        try:
            key = str(query.key_expr)
            if key != self._key:
                self._presence.close()
                token = self._session.liveliness().declare_token(keys.alive(key))
                self._presence.enter_context(token)
                self._key = key
            answer = self._desk.answer(bytes(query.payload or b""))
            query.reply(key, answer)
            self._session.put(keys.trace(key), answer)
        except Exception as error:
            traceback.print_exc()
            query.reply_err(in_one_line(error))


def _leave_when_closed(event: zenoh.TransportEvent) -> None:
    if event.kind == zenoh.SampleKind.DELETE:
        _leave()


def _leave() -> None:
    # The main thread may be deep in a search, and nobody is left to tell or to save for.
    os._exit(0)
