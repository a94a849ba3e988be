"""Histories that users write down: YAML in, checked for its form."""

from pathlib import Path

from pydantic import ValidationError

from asp.language import read_text
from asp.reasoning import Step
from testbed.config.composing import compose
from testbed.config.models import Section
from testbed.config.places import ConfigError, Places
from testbed.config.values import Literals


class ToldHistory(Section):
    """Steps, and the goal that some of them tell of."""

    goal: Literals = ()
    history: tuple[Step, ...]


def read_history(path: Path) -> tuple[ToldHistory, Places]:
    """The history of a file, and where everything stands in it.

    Raises ConfigError, SourceError for what is no text, and OSError.
    """
    text = read_text(path)
    places = Places(path, text, (), "")
    try:
        return ToldHistory.model_validate(compose(text, (), places)), places
    except ValidationError as error:
        found = [(each["loc"], each["msg"].lower()) for each in error.errors(include_url=False)]
        raise ConfigError(places.lines(found)) from None
