"""Check a configuration."""

from testbed.cli.common import Config, Overrides, Swept, emit, examples, input_errors

EPILOG = examples(
    "testbed check quickstart scenarios=[5] limits.steps=40",
    "testbed check office -m adversary.strategy=random adversary.rate=0:0.4:0.1",
)


def command(config: Config, overrides: Overrides = None, sweep: Swept = False) -> None:
    """Validate a configuration and print it as resolved.

    A warning says where an action of its domain has several outcomes, and where its effects
    contradict a constraint though no law says that it is impossible.
    """
    from asp.language import parse_description, read_domain
    from asp.translation import translate
    from testbed.cli.branching import warn_of_branching, warn_of_qualifications
    from testbed.cli.loading import load
    from testbed.experiment.run_folder import config_text

    with input_errors():
        resolved = load(config, overrides or [], sweep)
        emit(config_text(resolved))
        if not resolved.levels:  # each level's domain is made of rooms and cells, and branches not
            file, text = read_domain(resolved.domain)
            told = parse_description(text, file), translate(text, file), file
            warn_of_branching(*told)
            warn_of_qualifications(*told)
