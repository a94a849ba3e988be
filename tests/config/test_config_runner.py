"""Where trials are played: what goes together of runner, scheduler and the files for TLS."""

from pathlib import Path

import pytest

from testbed.config import ConfigError, load_config

CLUSTER = ("runner=dask", "scheduler=tls://head:8786")


@pytest.mark.parametrize(
    ("overrides", "key"),
    [
        (["scheduler=tcp://head:8786"], "scheduler"),
        (["runner=dask", "scheduler=head"], "scheduler"),
        (["runner=dask", "scheduler=tcp://head"], "scheduler"),
        (["runner=dask", "tls.ca=ca.pem"], "tls"),
        (["runner=dask", "scheduler=tcp://head:8786", "tls.ca=ca.pem"], "tls"),
        ([*CLUSTER], "tls"),
        ([*CLUSTER, "tls.cert=own.pem"], "tls.ca"),
        ([*CLUSTER, "tls.ca=ca.pem", "tls.key=own.key"], "tls.cert"),
        (["runner=remote"], "runner"),
    ],
)
def test_what_does_not_go_together_is_refused(overrides: list[str], key: str) -> None:
    with pytest.raises(ConfigError) as refused:
        load_config("quickstart", overrides)
    (line,) = refused.value.lines
    assert f" {key}: " in line


def test_files_for_tls_are_found_beside_the_configuration(tmp_path: Path) -> None:
    for name in ("ca", "cert", "key"):
        (tmp_path / f"{name}.pem").touch()
    lines = ["name: far", "goal: ['loc(book1,library)']", "runner: dask"]
    lines += ["scheduler: tls://head:8786", "tls: {ca: ca.pem, cert: cert.pem, key: key.pem}"]
    (tmp_path / "far.yaml").write_text("\n".join(lines), encoding="utf-8")
    tls = load_config(tmp_path / "far.yaml").tls
    assert tls.files == {name: str(tmp_path / f"{name}.pem") for name in ("ca", "cert", "key")}
