"""The levels of a configuration: their descriptions, and whether its settings fit these."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from asp.domains import LEVELS, LevelSize, level_text
from asp.language import read_domain, suggestion
from asp.refinement import Refinement, load, read_refinement, refined_name
from testbed.config.game import reward_findings
from testbed.config.models import TRIGGERS, ExperimentConfig
from testbed.config.places import Finding


def refinements(config: ExperimentConfig) -> Iterator[tuple[str, Refinement]]:
    """The levels of a configuration by name; a map of one's own is called as its file is.

    Raises SourceError for a mistake in a map's texts, OSError where one cannot be read.
    """
    if config.refinement is not None:
        yield Path(config.refinement).stem, refinement_of_files(config.domain, config.refinement)
    for name in config.levels:
        yield name, refinement_of_size(level_size(config, name))


def level_size(config: ExperimentConfig, name: str) -> LevelSize:
    """The size of a published level, or of one of the configuration's own. Raises KeyError."""
    if name in LEVELS:
        return LEVELS[name]
    return LevelSize(**dict(config.level_sizes[name]))


@cache
def refinement_of_size(size: LevelSize) -> Refinement:
    """The generated level of a size."""
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    return load(coarse, "level.al", fine, "level.fine")


def refinement_of_files(domain: str, refinement: str) -> Refinement:
    """A domain and its refinement, by names or paths. Raises SourceError and OSError."""
    file, text = read_domain(domain)
    fine_file, fine = read_refinement(refinement)
    return load(text, file, fine, fine_file)


MOST_CELLS = 20_000
"""Of a level, and parts of its objects."""
SCENARIO_KEYS = ("scenarios", "scenario_settings")
"""Keys that levels exclude."""


def settings_findings(config: ExperimentConfig) -> Iterator[Finding]:
    """What can be said without the levels' descriptions: keys that do not go together, names."""
    given = config.model_fields_set
    for key in SCENARIO_KEYS:
        if key in given and getattr(config, key):
            yield (key,), f"goes with no levels; give {key} or levels, not both"
    if config.repeats > 1:
        yield ("repeats",), "goes with scenarios; at levels `limit` says how many trials are drawn"
    if config.limit is None:
        yield ("limit",), "is missing; a level's trials are drawn: for example limit: 200"
    if config.refinement is not None and config.levels:
        yield ("levels",), "goes with no refinement, which is a level of its own; give one of them"
    elif config.levels and config.domain != ExperimentConfig.model_fields["domain"].default:
        yield ("domain",), "goes with no levels, which are made; with a domain give its refinement"
    if config.adversary.strategy == TRIGGERS:
        yield ("adversary", "strategy"), "triggers belong to scenarios; at levels events are random"
    yield from reward_findings(config.rewards)
    known = (*LEVELS, *config.level_sizes)
    for index, name in enumerate(config.levels):
        if name not in known:
            yield ("levels", index), f"unknown level '{name}'; {suggestion(name, known)}"
    for name, size in config.level_sizes.items():
        if name in LEVELS:
            yield ("level_sizes", name), "is a published level; give your own another name"
        cells = size.rooms * size.rows * size.columns
        parts = sum(number * of_each for number, of_each in size.objects)
        for what, number in (("cells", cells), ("parts of objects", parts)):
            if number > MOST_CELLS:
                yield ("level_sizes", name), f"has {number} {what}; {MOST_CELLS} are the most"


def map_findings(config: ExperimentConfig) -> Iterator[Finding]:
    """A map whose text names another domain than the one by default, where no domain is given.

    One that is given takes the place of the named one. Raises OSError and SourceError.
    """
    if config.refinement is not None and "domain" not in config.model_fields_set:
        file, named = Path(config.refinement).name, refined_name(config.refinement)
        if named not in (None, config.domain):
            unless = f"the domain is {config.domain} unless given; give domain: {named}"
            yield ("refinement",), f"{file} refines {named}, and {unless}"
