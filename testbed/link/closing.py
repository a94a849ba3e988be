"""Sessions that nobody has closed are closed when the program ends.

A session calls back into Python from threads for which the interpreter waits at its end, before it
runs what `atexit` was given: with one left open it would wait for ever. A thread of ours that waits
for the main one is waited for as well, and closes them.
"""

from threading import Lock, Thread, main_thread

import zenoh

_lock = Lock()
_sessions: list[zenoh.Session] = []
_waiting: list[Thread] = []


def close_at_exit(session: zenoh.Session) -> zenoh.Session:
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
