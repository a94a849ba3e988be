"""The explorer of a served report in a real browser: all trials of one run, or of several."""

import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path
from threading import Thread

import pytest

from asp.language import Action, Literal
from testbed.config import load_config
from testbed.experiment.record import Attempt
from testbed.experiment.run_folder import REPORT
from testbed.experiment.store import TrialWriter
from testbed.report import write_report
from testbed.report.page import page_of_several, written_report
from testbed.report.serving import Server, Site
from tests.experiment.samples import a_record
from tests.report.browser import AXE_CORE, CHROMIUM, DESK, PHONE, Browser, Tab
from tests.report.explorer import ROBOT, STEP, Played, chosen, drawn, slide, text

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here")

PAIRS = 30
"""More than are listed at once."""


@pytest.fixture(scope="module")
def many(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run with many pairs, of which one robot fails in the last."""
    folder = tmp_path_factory.mktemp("many")
    initial = ["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"]
    moved = [Attempt(1, Action.parse("move(rob1,office2)"), True)]
    with TrialWriter(folder) as writer:
        for number in range(PAIRS):
            for robot in ("intentional", "traditional"):
                lost = number == PAIRS - 1 and robot == "traditional"
                writer.append(
                    a_record(
                        f"{robot}-{number}",
                        pair=f"pair-{number:02}",
                        robot=robot,
                        steps=2,
                        actions=moved,
                        initial=[*map(Literal.parse, initial)],
                        achieved=not lost,
                        outcome="gave_up" if lost else "achieved",
                    )
                )
    return folder


@pytest.fixture(scope="module")
def address(many: Path) -> Iterator[str]:
    """Where the page of this run is served."""
    report = written_report(many, load_config("office"))
    yield from _served(Site(report.page(served=True), [report.run]))


def _served(site: Site) -> Iterator[str]:
    with Server(site) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        yield server.address
        server.shutdown()
        thread.join()


def test_a_served_page_has_all_trials_page_by_page(browser: Browser, address: str) -> None:
    tab = Tab(browser, address, DESK, "light")
    listed = "document.querySelectorAll('.found li').length"
    tab.until(f"{listed} && {ROBOT}.length")
    assert tab.evaluate("document.querySelector('.count').textContent").split()[0] == "60"
    assert tab.evaluate(listed) < PAIRS
    assert text(tab, "outcome", 1).startswith("✗")
    tab.evaluate("document.querySelector('[data-part=more]').click()")
    tab.until(f"{listed} === {PAIRS}")
    assert tab.evaluate("document.querySelector('[data-part=more]').hidden") is True
    tab.evaluate("document.querySelector('[data-trial=intentional-7]').click()")
    tab.until(f"{ROBOT}[0].textContent.includes('intentional-7')")
    assert drawn(tab, ["rob1"], ["kitchen", "office2"]) == ["kitchen"]
    slide(tab, 2)
    assert drawn(tab, ["rob1"], ["kitchen", "office2"]) == ["office2"]
    chosen(tab, "outcome", "gave_up")
    tab.until(f"{listed} === 1")
    assert tab.evaluate("[...document.querySelectorAll('.found .bad')].length") == 1
    asked = {event["request"]["url"] for event in tab.events("Network.requestWillBeSent")}
    assert all(url.startswith((address, "data:")) for url in asked)
    assert tab.complaints() == []


def test_a_link_to_a_served_page_opens_the_trial(browser: Browser, address: str) -> None:
    tab = Tab(browser, f"{address}#trial=traditional-3&step=2", DESK, "light")
    tab.until(f"{ROBOT}.length")
    assert tab.evaluate(STEP).split()[1] == "2"
    assert "traditional-3" in text(tab, "command", 1)
    tab = Tab(browser, f"{address}#trial=nosuch", DESK, "light")
    tab.until("document.querySelector('[data-part=warning]').textContent.includes('nosuch')")


def test_a_page_with_some_of_the_trials_says_so(
    browser: Browser, many: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("testbed.report.explorer.MOST_BYTES", 20_000)
    folder = tmp_path / "many o'clock"
    shutil.copytree(many, folder)
    write_report(folder, load_config("office"))
    tab = Tab(browser, folder / REPORT, DESK, "light")
    kept = "JSON.parse(document.getElementById('explorer-data').textContent).trials.length"
    held = tab.evaluate(kept)
    said = tab.evaluate("document.querySelector('[data-part=partial]').innerText")
    assert 0 < held < 2 * PAIRS
    assert said.startswith(f"{held} of {2 * PAIRS} ")
    command = tab.evaluate("document.querySelector('[data-part=partial] code').textContent")
    assert shlex.split(command) == ["testbed", "report", "--serve", str(folder)]


@pytest.fixture(scope="module")
def several(run: Played, many: Path) -> Iterator[str]:
    """Where the page of two runs is served."""
    reports = [
        written_report(run.page.parent, run.config),
        written_report(many, load_config("office", ["name=many"])),
    ]
    yield from _served(Site(page_of_several(reports), [own.run for own in reports]))


def test_trials_of_several_runs_are_told_apart(browser: Browser, run: Played, several: str) -> None:
    tab = Tab(browser, several, DESK, "light")
    tab.until(f"document.querySelector('.found li') && {ROBOT}.length")
    total = "document.querySelector('.count').textContent.split(' ')[0]"
    assert int(tab.evaluate(total)) == len(run.records) + 2 * PAIRS
    of_run = {record.trial for record in run.records}
    chosen(tab, "study", run.config.name)
    tab.until(f"{total} === '{len(of_run)}'")
    assert {*chosen(tab, "robot", "")} <= of_run
    chosen(tab, "study", "many")
    tab.until(f"{total} === '{2 * PAIRS}'")
    tab.evaluate("document.querySelector('.found [data-trial]').click()")
    tab.until(f"{ROBOT}[0].textContent.includes('-{PAIRS - 1}')")
    assert "many" in tab.evaluate("document.querySelector('[data-part=title]').textContent")
    assert tab.events("Runtime.consoleAPICalled", "Runtime.exceptionThrown") == []


@AXE_CORE
@pytest.mark.parametrize(("width", "scheme"), [(DESK, "dark"), (PHONE, "light")])
def test_no_rule_of_accessibility_is_broken_by_the_page_of_several_runs(
    browser: Browser, several: str, width: int, scheme: str
) -> None:
    tab = Tab(browser, several, width, scheme)
    tab.until(f"document.querySelector('.found li') && {ROBOT}.length")
    assert tab.violations() == []
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
