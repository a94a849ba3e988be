"""The templates of the report, and what they may do with text."""

from __future__ import annotations

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from testbed.experiment.wording import counted, in_words


def environment() -> Environment:
    """Templates in which text is escaped and a name that is not given is an error."""
    loader = PackageLoader("testbed.experiment.report", "templates")
    made = Environment(loader=loader, autoescape=True, undefined=StrictUndefined)
    made.filters |= {"atoms": _atoms, "counted": counted, "in_words": in_words}
    made.trim_blocks = made.lstrip_blocks = True
    return made


def _atoms(text: str) -> Markup:
    """Text that breaks at its spaces alone, and not inside of an atom."""
    return Markup(" ").join(Markup('<span class="atom">{}</span>').format(a) for a in text.split())
