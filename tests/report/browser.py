"""Headless Chromium, spoken to over pipes in its DevTools protocol."""

import fcntl
import json
import os
import select
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))),
    None,
)
AXE = Path(__file__).parent / "node_modules" / "axe-core" / "axe.min.js"
"""What `make test` installs by `package.json`."""
AXE_CORE = pytest.mark.skipif(
    not AXE.is_file(), reason="axe-core is not installed: npm ci in tests/report"
)
# Rules of WCAG 2 up to AA, and best practices, that a part of the page breaks.
VIOLATIONS = """axe.run(document, {resultTypes: ['violations']}).then(found =>
  found.violations.flatMap(rule => rule.nodes.map(node => [rule.id, node.html.slice(0, 120)])))"""
PHONE, DESK = 390, 1300
"""Widths of a page."""
PATIENCE_S = 600.0
HIGH = 20  # descriptors from here on are not those that the browser reads and writes
# A program of its own: what subprocess runs between fork and exec may hang where there are threads.
AS_EXPECTED = """
import os, sys
os.dup2(int(sys.argv[1]), 3)
os.dup2(int(sys.argv[2]), 4)
os.execv(sys.argv[3], sys.argv[3:])
"""
OPTIONS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--remote-debugging-pipe",
)
Event = dict[str, Any]


class Browser:
    """The process, and the messages that it sent so far."""

    def __init__(self, executable: str, profile: Path) -> None:
        reads, self._to = _pipe()
        self._from, writes = _pipe()
        browser = [executable, *OPTIONS, f"--user-data-dir={profile}"]
        self._process = subprocess.Popen(
            [sys.executable, "-c", AS_EXPECTED, str(reads), str(writes), *browser],
            pass_fds=(reads, writes),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(reads)
        os.close(writes)
        self._buffer = b""
        self._last = 0
        self.events: list[Event] = []

    def call(self, method: str, session: str | None = None, **parameters: object) -> Event:
        """Call a method of the protocol and wait for its result."""
        self._last += 1
        message: Event = {"id": self._last, "method": method, "params": parameters}
        if session is not None:
            message["sessionId"] = session
        os.write(self._to, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("id") == self._last:
                assert "error" not in answer, answer
                result: Event = answer["result"]
                return result
            self.events.append(answer)

    def receive(self) -> Event:
        """The next message."""
        deadline = time.monotonic() + PATIENCE_S
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._from], [], [], deadline - time.monotonic())
            assert ready, "the browser does not answer"
            read = os.read(self._from, 1 << 16)
            assert read, "the browser has ended"
            self._buffer += read
        line, _, self._buffer = self._buffer.partition(b"\0")
        message: Event = json.loads(line)
        return message

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()
        os.close(self._to)
        os.close(self._from)


def _pipe() -> tuple[int, int]:
    ends = os.pipe()
    high = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, HIGH) for end in ends]
    for end in ends:
        os.close(end)
    return high[0], high[1]


class Tab:
    """An open page: what it asked for, what it complained of, and a keyboard before it."""

    def __init__(
        self, browser: Browser, page: Path | str, width: int, scheme: str, motion: str = ""
    ) -> None:
        """`page` is a file, or an address."""
        self._browser = browser
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        attached = browser.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Network", "Log", "Runtime", "Page"):
            self.call(f"{domain}.enable")
        screen = {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False}
        self.call("Emulation.setDeviceMetricsOverride", **screen)
        features = [
            {"name": "prefers-color-scheme", "value": scheme},
            {"name": "prefers-reduced-motion", "value": motion},
        ]
        self.call("Emulation.setEmulatedMedia", features=features)
        address = page if isinstance(page, str) else page.as_uri()
        self.call("Page.navigate", url=address)
        self._wait("Page.loadEventFired")

    def call(self, method: str, **parameters: object) -> Event:
        """Call a method of the protocol for this page."""
        return self._browser.call(method, self._session, **parameters)

    def evaluate(self, expression: str) -> Any:
        """The value of an expression of JavaScript; of a promise what it comes to."""
        settings = {"returnByValue": True, "awaitPromise": True}
        answer = self.call("Runtime.evaluate", expression=expression, **settings)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def until(self, condition: str) -> None:
        """Wait until an expression of JavaScript is true."""
        look = f"const look = () => ({condition}) ? done() : setTimeout(look, 20)"
        self.evaluate(f"new Promise(done => {{ {look}; look(); }})")

    def press(self, key: str, code: int, text: str = "") -> None:
        """Press a key and let it go."""
        common = {"key": key, "code": key, "windowsVirtualKeyCode": code}
        self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **common)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def events(self, *methods: str) -> list[Event]:
        """The parameters of the events of these names."""
        own = [e for e in self._browser.events if e.get("sessionId") == self._session]
        return [event["params"] for event in own if event["method"] in methods]

    def complaints(self) -> list[Event]:
        """What the page wrote to the console, and errors that nothing caught."""
        return self.events("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded")

    def violations(self) -> list[list[str]]:
        """The rules of accessibility that axe-core finds broken, each with the element."""
        self.evaluate(AXE.read_text(encoding="utf-8") + ";0")
        broken: list[list[str]] = self.evaluate(VIOLATIONS)
        return broken

    def _wait(self, method: str) -> None:
        while not self.events(method):
            self._browser.events.append(self._browser.receive())
