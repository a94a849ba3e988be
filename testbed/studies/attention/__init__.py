"""How success, cost and time depend on which of the visible literals a robot heeds."""

from pathlib import Path

from testbed.studies.study import Study
from testbed.studies.sweeps import Found, sweep_study

STUDY: Study[Found] = sweep_study(
    ("achieved", "actions", "explanations", "reasoning"),
    "Success, cost and time by what is heeded",
    Path(__file__).with_name("section.html.j2"),
)
