"""Check a configuration."""

from testbed.cli.common import Config, Overrides, emit, examples, input_errors

EPILOG = examples("testbed check quickstart scenarios=[5] limits.steps=40")


def command(config: Config, overrides: Overrides = None) -> None:
    """Validate a configuration and print it as resolved."""
    from testbed.cli.loading import load
    from testbed.experiment.run_folder import config_text

    with input_errors():
        emit(config_text(load(config, overrides or [])))
