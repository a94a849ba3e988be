"""Reports of runs for browsers of this machine: the pages, and all trials as they ask for them."""

import re
from collections.abc import Sequence
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Lock
from urllib.parse import parse_qs

from testbed.analysis import Run
from testbed.report.catalogue import Catalogue, Query, QueryError
from testbed.report.explorer import encoded

HOST = "127.0.0.1"
PATIENCE_S = 30.0
"""How long a browser may take for its question."""
MOST_PARAMETERS = 16
TRIAL = re.compile(r"trial/([A-Za-z0-9_-]{1,64})\.json")
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; script-src 'unsafe-inline';"
    " style-src 'unsafe-inline'; img-src data:; connect-src 'self'; base-uri 'none';"
    " form-action 'none'; frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
HTML, JSON = "text/html; charset=utf-8", "application/json"
Answer = tuple[str, bytes]
"""The type of what is answered, and its text."""


class RefusedError(Exception):
    """A question that is not answered, and why."""

    def __init__(self, status: HTTPStatus, why: str) -> None:
        super().__init__(why)
        self.status = status


class Site:
    """What is served of runs: their page, the list of their trials, and each of these."""

    def __init__(self, page: str, runs: Sequence[Run]) -> None:
        self._page, self._catalogue = page.encode(), Catalogue(runs)

    def answer(self, path: str, query: str) -> Answer:
        """The answer to a question below the site's own address. Raises RefusedError."""
        if path == "":
            return HTML, self._page
        if path == "trials.json":
            return JSON, encoded(self._catalogue.found(_query(query)))
        trial = TRIAL.fullmatch(path)
        told = self._catalogue.pair(trial[1], _query(query)) if trial else None
        if told is None:
            raise RefusedError(HTTPStatus.NOT_FOUND, "no such trial" if trial else "no such page")
        return JSON, encoded(told)


def _query(text: str) -> Query:
    try:
        return Query.of(parse_qs(text, keep_blank_values=True, max_num_fields=MOST_PARAMETERS))
    except QueryError as error:
        raise RefusedError(HTTPStatus.BAD_REQUEST, str(error)) from None
    except ValueError:
        raise RefusedError(HTTPStatus.BAD_REQUEST, "too many parameters") from None


class Server(ThreadingHTTPServer):
    """Serves sites to browsers of this machine: one at `/`, its parts at `/1/`, `/2/`, ...

    It is ready when it is made; `serve_forever` answers until it is interrupted. Raises OSError
    where the port is taken; 0 is one that is free.
    """

    daemon_threads = True

    def __init__(self, whole: Site, parts: Sequence[Site] = (), port: int = 0) -> None:
        self._sites = {f"{number}/": own for number, own in enumerate(parts, start=1)}
        self._whole, self._lock = whole, Lock()
        try:
            super().__init__((HOST, port), Handler)
        except OSError as error:
            raise OSError(error.errno, error.strerror, f"{HOST}:{port}") from None
        own = self.server_address[1]
        self.address = f"http://{HOST}:{own}/"
        self.names = [[f"{name}:{own}"] for name in (HOST, "localhost")]

    def answer(self, target: str) -> Answer:
        """The answer to the question for a path with its query. Raises RefusedError."""
        path, _, query = target.partition("?")
        path = path.removeprefix("/")
        first, slash, rest = path.partition("/")
        part = self._sites.get(first + slash)
        with self._lock:  # what reads records is not made for several threads
            return part.answer(rest, query) if part else self._whole.answer(path, query)

    def handle_error(self, request: object, client_address: object) -> None:
        """A browser that went away is no error."""


class Handler(BaseHTTPRequestHandler):
    """One question: only GET, and only from a page of this server, by its own name."""

    server: Server
    timeout = PATIENCE_S
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "testbed", ""

    def do_GET(self) -> None:
        """Answer, whatever happens, with what was asked for or with an error as JSON."""
        try:
            # Another name that leads here is that of a page elsewhere (DNS rebinding).
            if self.headers.get_all("Host", []) not in self.server.names:
                raise RefusedError(HTTPStatus.FORBIDDEN, f"ask for {self.server.address}")
            kind, text = self.server.answer(self.path)
        except RefusedError as refusal:
            self.send_error(refusal.status, str(refusal))
        except Exception as error:  # whatever it is, a browser is told that, and no more
            self.send_error(HTTPStatus.INTERNAL_SERVER_ERROR, type(error).__name__)
        else:
            self._send(HTTPStatus.OK, kind, text)

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Errors, also those that the library finds, are JSON."""
        if code == HTTPStatus.NOT_IMPLEMENTED:  # another method than GET
            code, message = HTTPStatus.METHOD_NOT_ALLOWED, "only GET"
        self.close_connection = True
        self._send(code, JSON, encoded({"code": int(code), "message": message or explain or ""}))

    def _send(self, code: int, kind: str, text: bytes) -> None:
        self.send_response(code)
        for name, value in HEADERS.items():
            self.send_header(name, value)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(text)))
        if code == HTTPStatus.METHOD_NOT_ALLOWED:
            self.send_header("Allow", "GET")
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(text)

    def log_message(self, format: str, *args: object) -> None:
        """Nothing is said of single questions."""
