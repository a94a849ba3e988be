"""The templates of the report, and what they may do with text."""

from __future__ import annotations

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from testbed.experiment.wording import counted, in_words
from testbed.text.terminal import plain


def environment() -> Environment:
    """Templates in which text is escaped and a name that is not given is an error."""
    loader = PackageLoader("testbed.report", "templates")
    made = Environment(loader=loader, autoescape=True, undefined=StrictUndefined, finalize=_visible)
    made.filters |= {"atoms": _atoms, "counted": counted, "in_words": in_words}
    made.trim_blocks = made.lstrip_blocks = True
    return made


def _visible(value: object) -> object:
    """Text of users and robots without what would steer its direction; blanks may stay."""
    if isinstance(value, str) and not hasattr(value, "__html__"):
        return plain(value, keep="\n\r\t")
    return value


def _atoms(text: str) -> Markup:
    """Text that breaks at its spaces alone, and not inside of an atom."""
    atoms = (Markup('<span class="atom">{}</span>').format(plain(atom)) for atom in text.split())
    return Markup(" ").join(atoms)
