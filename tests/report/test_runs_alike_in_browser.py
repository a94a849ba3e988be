"""Two runs of one configuration in one served page, in a real browser: their trials share ids."""

import json
import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from testbed.config import load_config
from testbed.experiment.run_folder import write_config
from testbed.experiment.store import TrialWriter
from testbed.report.page import page_of_several, written_report
from testbed.report.serving import Server, Site
from tests.experiment.samples import a_record
from tests.report.browser import CHROMIUM, Browser, Tab

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here")

WIDTH = 1300
SHOWN = "[...document.querySelectorAll('.robot [data-part=command]')].map(own => own.textContent)"
"""The commands that replay the trials that are shown."""
NAMED = "new URLSearchParams(location.hash.slice(1)).get('study')"
"""The study that the address names."""


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    first, second = (tmp_path_factory.mktemp("alike") / name for name in ("first", "second"))
    config = load_config("office", ["name=own"])
    write_config(first, config)
    with TrialWriter(first) as writer:
        for robot in ("one", "two"):
            writer.append(a_record(f"t-{robot}", pair="p", robot=robot, steps=2))
    shutil.copytree(first, second)
    return [first, second]


@pytest.fixture(scope="module")
def address(folders: list[Path]) -> Iterator[str]:
    """Where the page of both is served."""
    reports = [written_report(own, load_config(own / "config.yaml")) for own in folders]
    site = Site(page_of_several(reports), [own.run for own in reports])
    with Server(site) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        yield server.address
        server.shutdown()
        thread.join()


def _choose(tab: Tab, study: str) -> None:
    """Leave the trials of one run in the list."""
    tab.evaluate(f"""(() => {{
      const select = document.querySelector('select[name=study]');
      select.value = {json.dumps(study)};
      select.dispatchEvent(new Event('change', {{bubbles: true}}));
    }})()""")
    tab.until("document.querySelectorAll('.found li').length === 1")


def _folders(tab: Tab) -> set[str]:
    """The folders that the trials which are shown are replayed from."""
    commands: list[Any] = tab.evaluate(SHOWN)
    assert len(commands) == 2
    return {shlex.split(command)[2] for command in commands}


def test_each_shows_its_own_trials_and_has_links_to_them(
    browser: Browser, address: str, folders: list[Path]
) -> None:
    tab = Tab(browser, address, WIDTH, "light")
    tab.until("document.querySelectorAll('.found li').length === 2")
    links = []
    for folder in (*folders, folders[0]):
        study = f"own ({folder})"
        _choose(tab, study)
        tab.evaluate("document.querySelector('.found [data-trial=t-two]').click()")
        tab.until(f"{NAMED} === {json.dumps(study)}")
        assert _folders(tab) == {str(folder)}
        links.append(tab.evaluate("location.hash"))
    assert links[0] == links[2] != links[1]
    for folder, link in zip(folders, links, strict=False):
        opened = Tab(browser, f"{address}{link}", WIDTH, "light")
        opened.until(f"{SHOWN}.length")
        assert _folders(opened) == {str(folder)}
    assert tab.events("Runtime.consoleAPICalled", "Runtime.exceptionThrown") == []
