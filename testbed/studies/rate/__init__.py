"""How success and cost depend on how much happens: random events per step, from 0 to 1."""

from pathlib import Path

from testbed.studies.study import Study
from testbed.studies.sweeps import Found, sweep_study

STUDY: Study[Found] = sweep_study(
    ("achieved", "actions", "explanations"),
    "Success and cost by the rate of events",
    Path(__file__).with_name("section.html.j2"),
)
