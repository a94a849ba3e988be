"""Overrides with several values are a sweep to each command that takes them with -m."""

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from testbed.cli import app
from testbed.config import conditions_of, load_config
from tests.config.test_sweep import written

COMMANDS = ["check", "run"]


def _call(*arguments: str | Path) -> Result:
    return CliRunner().invoke(app, [str(part) for part in arguments])


@pytest.fixture
def pots(tmp_path: Path) -> Path:
    """A configuration in the greenhouse."""
    return written(tmp_path)


def test_a_checked_sweep_is_printed_as_resolved(pots: Path) -> None:
    checked = _call("check", pots, "-m", "adversary.rate=0:1:0.5", "knowledge=complete,seen")
    assert checked.exit_code == 0, checked.output
    (pots.parent / "resolved.yaml").write_text(checked.stdout, encoding="utf-8")
    found = conditions_of(load_config(pots.parent / "resolved.yaml"))
    assert {(own.adversary.rate, own.knowledge) for own in found.values()} == {
        (rate, knowledge) for rate in (0.0, 0.5, 1.0) for knowledge in ("complete", "seen")
    }


def test_without_the_option_several_values_are_one(pots: Path) -> None:
    refused = _call("check", pots, "adversary.rate=0.1,0.2")
    assert refused.exit_code == 2
    assert "adversary.rate" in refused.stderr


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("adversary.rate=0.5,7", "adversary.rate=7: adversary.rate: "),
        ("adversary.rate=1,[a:}]", "adversary.rate: '[a:}]'"),
        ("robots=intentional,traditional", "cannot vary robots"),
    ],
)
def test_a_mistake_is_told_in_one_line(
    command: str, override: str, said: str, pots: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(pots.parent)
    refused = _call(command, pots, "-m", override)
    assert refused.exit_code == 2, refused.output
    (line,) = refused.stderr.splitlines()
    assert line.startswith("command line: ")
    assert said in line
