"""How success and cost depend on what a robot is told of events, how truly, and how late."""

from pathlib import Path

from testbed.studies.study import Study
from testbed.studies.sweeps import Found, sweep_study

STUDY: Study[Found] = sweep_study(
    ("achieved", "explanations"),
    "Success and cost by what is told of events",
    Path(__file__).with_name("section.html.j2"),
)
