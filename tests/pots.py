"""A gardener who carries a pot: a configuration, and a robot of one's own for it."""

from pathlib import Path

from tests.greenhouse import GREENHOUSE

POTS = """\
name: pots
domain: pots.al
goal: ["stands(fern,sill)"]
link: inprocess
repeats: 2
adversary: {strategy: random, rate: 0.3}
"""
"""36 trials of two robots, in which others act at random."""
CARRIED = """\
from testbed.protocol import Decision, Trace


def carried(percept):
    holds = "stands(fern,sill)" in percept.visible
    return Decision(
        trial=percept.trial,
        step=percept.step,
        action="finish" if holds else "carry(gardener,fern,sill)",
        believes_goal=holds,
        trace=Trace(),
    )
"""
"""A module in which a robot finds what it does."""
HOLDING = """\
import time
from pathlib import Path

from helping_carriers import carried

from testbed.protocol import Capabilities

HOLD = Path({hold!r})


class Held:
    '''Waits before its fourth trial as long as there is a file.'''

    capabilities = Capabilities()
    begun = 0

    def begin(self, task):
        while Held.begun == 3 and HOLD.exists():
            time.sleep(0.01)
        Held.begun += 1

    def act(self, percept):
        return carried(percept)
"""


def write_pots(folder: Path, config: str = POTS, **modules: str) -> Path:
    """The configuration, its domain, and modules, in a folder."""
    folder.mkdir(exist_ok=True)
    (folder / "pots.al").write_text(GREENHOUSE, encoding="utf-8")
    (folder / "pots.yaml").write_text(config, encoding="utf-8")
    for name, text in modules.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    return folder / "pots.yaml"
