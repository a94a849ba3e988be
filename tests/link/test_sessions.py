"""What every session asks of zenoh, whoever opens it."""

from collections.abc import Callable
from pathlib import Path

import pytest
import zenoh

from testbed.link import open_as_configured, open_driver, open_robot, open_waiting

SHARED = "transport/shared_memory/enabled"
ENDPOINT = "tcp/127.0.0.1:1"


class _OpenedError(Exception):
    """Carries the configuration of a session instead of opening it."""


def _asked(monkeypatch: pytest.MonkeyPatch, open_session: Callable[[], object]) -> zenoh.Config:
    def opened(config: zenoh.Config) -> None:
        raise _OpenedError(config)

    monkeypatch.setattr(zenoh, "open", opened)
    with pytest.raises(_OpenedError) as caught:
        open_session()
    config = caught.value.args[0]
    assert isinstance(config, zenoh.Config)
    return config


@pytest.mark.parametrize(
    "open_session", [open_driver, lambda: open_robot(ENDPOINT), lambda: open_waiting(ENDPOINT)]
)
def test_no_session_needs_shared_memory(
    monkeypatch: pytest.MonkeyPatch, open_session: Callable[[], object]
) -> None:
    """In a container /dev/shm may be read-only: zenoh then refuses to open a session with it."""
    assert _asked(monkeypatch, open_session).get_json(SHARED) == "false"


@pytest.mark.parametrize(
    ("text", "shared"),
    [
        ("{}", "false"),
        ("{transport: {shared_memory: {enabled: true}}}", "true"),
        ("{transport: {shared_memory: {enabled: false}}}", "false"),
    ],
)
def test_a_configuration_may_ask_for_shared_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, shared: str
) -> None:
    file = tmp_path / "zenoh.json5"
    file.write_text(text, encoding="utf-8")
    config = _asked(monkeypatch, lambda: open_as_configured(file))
    assert config.get_json(SHARED) == shared
