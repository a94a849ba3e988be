"""A trial as a notebook shows it: how it came out, and what happened step by step."""

from __future__ import annotations

from markupsafe import Markup

from testbed.experiment.record import TrialRecord
from testbed.experiment.wording import in_words, of_place
from testbed.report.stories import timeline

_TRIAL = Markup(
    "<table><caption>{caption}</caption><thead><tr><th>step</th><th>robot</th><th>others</th>"
    "<th>explained by</th></tr></thead><tbody>{rows}</tbody></table>"
)
_ROW = Markup(
    "<tr><td>{0.number}</td><td>{0.robot}</td><td>{0.others}</td><td>{0.explained}</td></tr>"
)


def html_of(record: TrialRecord) -> str:
    """The record as a table in HTML."""
    where = of_place(record.scenario, record.level)
    outcome = in_words(record.outcome) + (f": {record.reason}" if record.reason else "")
    goal = ", ".join(record.goal)
    caption = f"{record.trial}: {record.robot} in {record.domain}, {where}; goal: {goal}; {outcome}"
    rows = Markup("").join(_ROW.format(step) for step in timeline(record))
    return str(_TRIAL.format(caption=caption, rows=rows))
