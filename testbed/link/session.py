"""Opening zenoh sessions that keep to themselves.

A driver listens on a loopback port that the system picks; its robots connect to that endpoint
and listen nowhere. Without multicast and gossip nobody finds anybody else: nothing leaves the
machine, and two runs side by side never meet.

Use every session in a ``with`` block. One that is left open is closed when the program ends, before
it would keep the interpreter from ending.
"""

import json
from pathlib import Path
from threading import Lock, Thread, main_thread
from typing import Any

import zenoh

LOOPBACK = "tcp/127.0.0.1:0"
CONNECT_S = 10.0
LEASE_S = 3600
"""How long the other end waits for a process that is silent because it is paused.

The end of a process is noticed at once, for its connection closes, and a robot that does not
answer meets the answer limit. zenoh's own 10 s would end trials in a pause of any longer.
"""

_NO_SHARED_MEMORY = {"transport/shared_memory/enabled": False}  # /dev/shm may be read-only
_SECLUDED: dict[str, Any] = {
    "mode": "peer",
    "scouting/multicast/enabled": False,
    "scouting/gossip/enabled": False,
    "transport/link/tx/lease": LEASE_S * 1000,
} | _NO_SHARED_MEMORY

_lock = Lock()
_sessions: list[zenoh.Session] = []
_waiting: list[Thread] = []


def open_driver() -> zenoh.Session:
    """Open a session to which robots of this machine can connect, at :func:`endpoint`."""
    # The admin space is how a session tells which port the system gave it.
    return _open({"listen/endpoints": [LOOPBACK], "adminspace/enabled": True})


def open_robot(driver: str) -> zenoh.Session:
    """Open a session connected to the endpoint of a driver, or of a router.

    Raises zenoh.ZError when nobody listens there.
    """
    return _open(_connecting(driver, int(CONNECT_S * 1000), True))


def open_waiting(endpoint: str) -> zenoh.Session:
    """Open a session that connects to an endpoint as soon, and as often, as somebody is there."""
    return _open(_connecting(endpoint, -1, False))


def _connecting(endpoint: str, timeout_ms: int, exit_on_failure: bool) -> dict[str, Any]:
    return {
        "listen/endpoints": [],
        "connect/endpoints": [endpoint],
        "connect/timeout_ms": timeout_ms,
        "connect/exit_on_failure": exit_on_failure,
    }


def open_as_configured(file: Path, also: str | None = None) -> zenoh.Session:
    """Open a session as a zenoh configuration says, and connect to one more endpoint.

    Shared memory is off unless the configuration has a word on it. Raises zenoh.ZError for a
    configuration that zenoh does not accept.
    """
    config = zenoh.Config.from_file(str(file))
    if "shared_memory" not in file.read_text(encoding="utf-8"):
        _insert(config, _NO_SHARED_MEMORY)
    if also is not None:
        stated = json.loads(config.get_json("connect/endpoints"))
        _insert(config, {"connect/endpoints": _with(also, stated)})
    return _closed_at_exit(zenoh.open(config))


def _with(endpoint: str, stated: Any) -> Any:
    """Endpoints, in any of the forms that zenoh knows, with one more."""
    if isinstance(stated, dict):
        return {mode: [*stated.get(mode, ()), endpoint] for mode in ("router", "peer", "client")}
    return [*stated, endpoint]


def endpoint(session: zenoh.Session) -> str:
    """Return the endpoint at which a driver's session listens, ``tcp/127.0.0.1:<port>``."""
    for reply in session.get(f"@/{session.zid()}/peer"):
        if reply.ok is not None:
            return str(json.loads(reply.ok.payload.to_string())["locators"][0])
    raise RuntimeError("the zenoh session does not tell where it listens")


def _open(settings: dict[str, Any]) -> zenoh.Session:
    config = zenoh.Config()
    _insert(config, _SECLUDED | settings)
    return _closed_at_exit(zenoh.open(config))


def _insert(config: zenoh.Config, settings: dict[str, Any]) -> None:
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))


def _closed_at_exit(session: zenoh.Session) -> zenoh.Session:
    """Close the session, if it is still open then, after the main thread has ended."""
    with _lock:
        _sessions[:] = [known for known in _sessions if not known.is_closed()]
        _sessions.append(session)
        if not _waiting:
            _waiting.append(Thread(target=_close_all, name="closing zenoh sessions"))
            _waiting[0].start()
    return session


def _close_all() -> None:
    main_thread().join()
    with _lock:
        for session in _sessions:
            if not session.is_closed():
                session.close()  # type: ignore[no-untyped-call]
