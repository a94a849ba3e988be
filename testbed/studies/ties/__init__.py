"""How success depends on which of several equally small explanations a robot adopts."""

from pathlib import Path

from testbed.studies.study import Study
from testbed.studies.sweeps import Found, sweep_study

STUDY: Study[Found] = sweep_study(
    ("achieved", "actions", "explanations", "action_first"),
    "Success by the order of equally small explanations",
    Path(__file__).with_name("section.html.j2"),
)
