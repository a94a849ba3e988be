"""What tests of the explorer in a browser share: a run to look at, and a hand at its page."""

import json
from collections.abc import Sequence
from pathlib import Path

from testbed.config import ExperimentConfig
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import REPORT
from testbed.experiment.runner import play_missing
from testbed.experiment.store import read_records
from testbed.report import write_report
from tests.report.browser import Tab

ROBOT = "document.querySelectorAll('.robot')"
STEP = "document.querySelector('.transport output').textContent"

# In which room of the first robot's drawing each of these names stands; of a room its own name.
ROOMS = """((which, names, rooms) => {
  const svg = document.querySelector(`.robot [data-part=${which}] svg`);
  const texts = [...svg.querySelectorAll('text')];
  const boxes = [...svg.querySelectorAll('rect')].map(own => own.getBoundingClientRect());
  const around = name => {
    const text = texts.find(own => own.textContent === name)?.getBoundingClientRect();
    const holds = box => box.left <= text.left && text.right <= box.right
      && box.top <= text.top && text.bottom <= box.bottom;
    return text && boxes.filter(holds).sort((a, b) => b.width * b.height - a.width * a.height)[0];
  };
  return names.map(name => rooms.find(room => around(room) === around(name)) ?? null);
})"""


class Played:
    """A run with its page and its records."""

    def __init__(self, folder: Path, config: ExperimentConfig) -> None:
        play_missing(config, folder, 1, lambda _: None)
        write_report(folder, config)
        self.config, self.page = config, folder / REPORT
        self.records = list(read_records(folder))

    def one(self, scenario: str, robot: str) -> TrialRecord:
        """The first record of a robot in a scenario."""
        found = (r for r in self.records if (r.scenario, r.robot) == (scenario, robot))
        return next(found)

    def address(self, record: TrialRecord, step: int = 1) -> str:
        """The link to a step of a trial."""
        return f"{self.page.as_uri()}#trial={record.trial}&step={step}"


def chosen(tab: Tab, key: str, value: str) -> list[str]:
    """The trials that are listed once a filter has a value."""
    tab.evaluate(f"""(() => {{
      const select = document.querySelector('select[name={key}]');
      select.value = {json.dumps(value)};
      select.dispatchEvent(new Event('change', {{bubbles: true}}));
    }})()""")
    listed: list[str] = tab.evaluate(
        "[...document.querySelectorAll('.found [data-trial]')].map(own => own.dataset.trial)"
    )
    return listed


def slide(tab: Tab, step: int) -> None:
    """Move the slider to a step."""
    tab.evaluate(f"""(() => {{
      const slider = document.querySelector('input[type=range]');
      slider.value = {step};
      slider.dispatchEvent(new Event('input', {{bubbles: true}}));
    }})()""")


def drawn(tab: Tab, names: Sequence[str], rooms: Sequence[str], which: str = "world") -> list[str]:
    """The rooms in which these names stand in the first robot's world, or in its belief."""
    given = ", ".join(json.dumps(own) for own in (which, list(names), list(rooms)))
    found: list[str] = tab.evaluate(f"{ROOMS}({given})")
    return found


def text(tab: Tab, part: str, robot: int = 0) -> str:
    """The text that a part of a robot's trial shows."""
    shown: str = tab.evaluate(f"{ROBOT}[{robot}].querySelector('[data-part={part}]').innerText")
    return shown
