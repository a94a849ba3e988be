"""Where trials are played: in processes of this machine, or by a Dask cluster."""

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal

from testbed.config.places import Finding
from testbed.config.values import Name, Section

if TYPE_CHECKING:
    from testbed.config.models import ExperimentConfig

Runner = Literal["local", "dask"]
ADDRESS = re.compile(r"(tcp|tls|ws|wss)://\S+:\d+")
ENCRYPTED = ("tls://", "wss://")


class Tls(Section):
    """Files in PEM with which a scheduler is spoken to: authority, certificate, its key.

    They are taken relative to the configuration. Without a `key` the certificate's file has it.
    """

    ca: Name | None = None
    cert: Name | None = None
    key: Name | None = None

    @property
    def files(self) -> dict[str, str]:
        """The files that are given, by their keys."""
        return {key: file for key, file in self if file is not None}


def runner_findings(config: "ExperimentConfig") -> Iterator[Finding]:
    """What does not go together of `runner`, `scheduler` and `tls`."""
    scheduler = config.scheduler
    if scheduler is not None and config.runner != "dask":
        yield ("scheduler",), "goes with runner: dask"
    if scheduler is not None and not ADDRESS.fullmatch(scheduler):
        yield ("scheduler",), "should be an address such as tcp://192.168.0.7:8786"
    encrypted = scheduler is not None and scheduler.startswith(ENCRYPTED)
    if config.tls.files and not encrypted:
        yield ("tls",), "goes with a scheduler at tls://"
    if encrypted and not config.tls.files:
        yield ("tls",), "is missing; a scheduler at tls:// wants ca, cert and key, files in PEM"
    elif encrypted:
        for key in ("ca", "cert"):
            if key not in config.tls.files:
                yield ("tls", key), "is missing; a file in PEM"
