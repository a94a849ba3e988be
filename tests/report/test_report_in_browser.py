"""The report in a real browser: quiet, alone, readable in any light, narrow, by keyboard."""

from pathlib import Path

import pytest

from testbed.config import load_config
from testbed.experiment.run_folder import REPORT
from testbed.experiment.runner import play_missing
from testbed.experiment.status import RunStatus
from testbed.report import write_report
from tests.report.browser import AXE_CORE, CHROMIUM, DESK, PHONE, Browser, Tab

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here")

RUNS = {
    "table1": ("table1", ["limit=2"]),
    "levels": ("levels", ["levels=[L1,L2]", "limit=1"]),
    "quickstart": ("quickstart", ["link=inprocess"]),
}
TAB, ENTER = ("Tab", 9), ("Enter", 13, "\r")

# The text of least contrast with what is behind it, by WCAG 2, and that contrast.
CONTRAST = """(() => {
  const canvas = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  const rgba = text => {
    canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = text; canvas.fillRect(0, 0, 1, 1);
    return canvas.getImageData(0, 0, 1, 1).data;
  };
  const light = text => [...rgba(text)].slice(0, 3).map(v => v / 255)
    .map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = element => {
    for (let at = element; at; at = at.parentElement) {
      const colour = getComputedStyle(at).backgroundColor;
      if (rgba(colour)[3] === 255) return colour;
    }
  };
  let worst = [21, ''];
  for (const element of document.querySelectorAll('body *')) {
    const own = [...element.childNodes].some(n => n.nodeType === 3 && n.textContent.trim());
    if (!own || !element.getClientRects().length) continue;
    const style = getComputedStyle(element);
    const colour = element instanceof SVGElement ? style.fill : style.color;
    if (rgba(colour)[3] === 0) continue;
    const [a, b] = [light(colour), light(behind(element))].sort((x, y) => y - x);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < worst[0]) worst = [contrast, element.textContent.trim().slice(0, 60)];
  }
  return worst;
})()"""


@pytest.fixture(scope="module", params=RUNS)
def page(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report of a small run."""
    name, overrides = RUNS[request.param]
    folder = tmp_path_factory.mktemp(name)
    config = load_config(name, overrides)
    play_missing(config, folder, 1, _ignore)
    write_report(folder, config)
    return folder / REPORT


def _ignore(tally: RunStatus) -> None:
    del tally


def test_it_asks_for_nothing_and_complains_of_nothing(browser: Browser, page: Path) -> None:
    tab = Tab(browser, page, DESK, "light")
    asked = [event["request"]["url"] for event in tab.events("Network.requestWillBeSent")]
    assert {url for url in asked if not url.startswith("data:")} == {page.as_uri()}
    assert tab.complaints() == []
    assert tab.evaluate("document.querySelectorAll('h2').length") >= 4


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_text_stands_out_from_what_is_behind_it(
    browser: Browser, page: Path, scheme: str
) -> None:
    tab = Tab(browser, page, DESK, scheme)
    tab.evaluate("document.querySelectorAll('details').forEach(own => own.open = true)")
    contrast, text = tab.evaluate(CONTRAST)
    assert contrast >= 4.5, text


def test_dark_is_dark(browser: Browser, page: Path) -> None:
    background = "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)"
    assert min(Tab(browser, page, DESK, "light").evaluate(background)) > 200
    assert max(Tab(browser, page, DESK, "dark").evaluate(background)) < 60


@pytest.mark.parametrize("opened", [False, True])
def test_a_phone_shows_its_whole_width(browser: Browser, page: Path, opened: bool) -> None:
    tab = Tab(browser, page, PHONE, "light")
    tab.evaluate(f"document.querySelectorAll('details').forEach(own => own.open = {int(opened)})")
    assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE
    too_wide = "[...document.querySelectorAll('figure svg, table')]"
    assert tab.evaluate(f"Math.max(...{too_wide}.map(own => own.clientWidth))") <= PHONE


def test_a_keyboard_gets_to_every_part_and_opens_what_is_closed(
    browser: Browser, page: Path
) -> None:
    tab = Tab(browser, page, DESK, "light")
    for link in range(tab.evaluate("document.querySelectorAll('nav a').length")):
        tab.press(*TAB)
        address = tab.evaluate("document.activeElement.getAttribute('href')")
        assert address == tab.evaluate(f"document.querySelectorAll('nav a')[{link}].hash")
        assert tab.evaluate(f"document.querySelectorAll('{address}').length") == 1
    for _ in range(100):
        tab.press(*TAB)
        if tab.evaluate("document.activeElement.tagName") == "SUMMARY":
            break
    assert tab.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"
    tab.press(*ENTER)
    assert tab.evaluate("document.activeElement.parentElement.open") is True


@AXE_CORE
@pytest.mark.parametrize(("width", "scheme"), [(DESK, "light"), (DESK, "dark"), (PHONE, "light")])
def test_no_rule_of_accessibility_is_broken(
    browser: Browser, page: Path, width: int, scheme: str
) -> None:
    tab = Tab(browser, page, width, scheme)
    tab.evaluate("document.querySelectorAll('details').forEach(own => own.open = true)")
    assert tab.violations() == []


def test_each_table_says_what_it_is_and_each_row_whose_it_is(browser: Browser, page: Path) -> None:
    tab = Tab(browser, page, DESK, "light")
    tables = "[...document.querySelectorAll('table')]"
    assert tab.evaluate(f"{tables}.every(own => own.caption.textContent.trim())")
    rows = f"{tables}.flatMap(own => [...own.tBodies[0].rows])"
    assert tab.evaluate(f"{rows}.length") > 0
    assert tab.evaluate(f"{rows}.every(own => own.cells[0].scope === 'row')")


def test_steps_that_succeed_fail_and_think_differ_in_shape(browser: Browser, page: Path) -> None:
    """Not in their colour alone: each is drawn as with one colour for all."""
    tab = Tab(browser, page, DESK, "light")
    tab.evaluate("""['done', 'failed', 'mental'].forEach(name =>
        document.documentElement.style.setProperty('--' + name, 'rgb(1, 2, 3)'))""")
    shape = "own => (s => s.backgroundColor + s.backgroundImage + s.borderTopWidth)"
    marks = "[...document.querySelectorAll('.legend .strip i:not(.touched)')]"
    assert tab.evaluate(f"new Set({marks}.map({shape}(getComputedStyle(own)))).size") == 3


def test_a_phone_shows_both_robots_of_a_row_at_once(browser: Browser, page: Path) -> None:
    tab = Tab(browser, page, PHONE, "light")
    rows = "[...document.querySelectorAll('table.compared tbody tr')]"
    assert tab.evaluate(f"{rows}.length") > 0
    assert tab.evaluate(f"Math.max(...{rows}.map(own => own.clientHeight))") < 800
    assert tab.evaluate(f"Math.max(...{rows}.map(own => own.scrollWidth))") <= PHONE
