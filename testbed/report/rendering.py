"""The templates of the report and of studies, and what they may do with text."""

from collections.abc import Iterable
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from testbed.experiment.timeline import in_words, of_place, timeline
from testbed.studies import Chart, Section
from testbed.text import chance, counted, number, plain


def rendered(section: Section) -> Markup:
    """A section of a study as HTML, by its own template where it has one."""
    made = environment()
    if section.template is None:
        template = made.get_template("section.html.j2")
    else:
        template = made.from_string(section.template.read_text(encoding="utf-8"))
    return Markup(template.render({"section": section, **(section.values or {})}))


def environment() -> Environment:
    """Templates in which text is escaped and a name that is not given is an error."""
    loader = PackageLoader("testbed.report", "templates")
    made = Environment(loader=loader, autoescape=True, undefined=StrictUndefined, finalize=_visible)
    made.filters |= {
        "atoms": _atoms,
        "chance": chance,
        "counted": counted,
        "drawn": _drawn,
        "events": lambda own: ", ".join(f"{e.action} at step {e.step}" for e in own.exogenous),
        "in_words": in_words,
        "number": number,
        "of_place": lambda own: of_place(own.scenario, own.level),
        "steps": lambda own: list(timeline(own)),
    }
    made.trim_blocks = made.lstrip_blocks = True
    return made


def _visible(value: object) -> object:
    """Text of users and robots without what would steer its direction; blanks may stay."""
    if isinstance(value, str) and not hasattr(value, "__html__"):
        return plain(value, keep="\n\r\t")
    return value


def _drawn(charts: Iterable[Chart]) -> list[Any]:
    """Charts as figures."""
    from testbed.report.figures import drawn  # noqa: PLC0415  # slow, and few runs have figures

    return list(map(drawn, charts))


def _atoms(text: str) -> Markup:
    """Text that breaks at its spaces alone, and not inside of an atom."""
    atoms = (Markup('<span class="atom">{}</span>').format(plain(atom)) for atom in text.split())
    return Markup(" ").join(atoms)
