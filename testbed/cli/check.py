"""Check a configuration."""

from __future__ import annotations

import typer

from testbed.cli.common import Config, Overrides, examples, input_errors

EPILOG = examples("testbed check quickstart scenarios=[5] limits.steps=40")


def command(config: Config, overrides: Overrides = None) -> None:
    """Validate a configuration and print it as resolved."""
    from testbed.experiment.loading import load
    from testbed.experiment.run_config import config_text

    with input_errors():
        typer.echo(config_text(load(config, overrides or [])), nl=False)
