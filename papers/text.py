"""The text of pages: templates in Markdown, and what they may do with values."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from papers.markdown import markdown, paragraph
from testbed.text import number

TEMPLATES = Path(__file__).with_name("templates")


def render(name: str, **values: object) -> str:
    """A template of Markdown with its values."""
    made = Environment(
        loader=FileSystemLoader(TEMPLATES),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.filters |= {"paragraph": paragraph, "percent": percent, "table": table, "times": number}
    return made.get_template(f"{name}.md.j2").render(values)


def table(rows: Iterable[Sequence[str]], columns: Sequence[str]) -> str:
    """Rows under the names of columns."""
    return markdown(columns, rows)


def percent(share: float) -> str:
    """A share in whole percents."""
    return f"{100 * share:.0f}%"
