"""How success and cost depend on what is known of the start, where defaults are right or wrong."""

from pathlib import Path

from testbed.studies.study import Study
from testbed.studies.sweeps import Found, sweep_study

STUDY: Study[Found] = sweep_study(
    ("achieved", "actions", "explanations"),
    "Success and cost by what is known of the start",
    Path(__file__).with_name("section.html.j2"),
)
