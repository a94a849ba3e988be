"""A picture of a part of a page, as Chromium shows it.

    python -m tests.report.screenshot runs/quickstart/report.html docs/images/explorer.png \\
        --part .player --at 'trial=TRIAL_ID&step=5'
"""

import argparse
from base64 import b64decode
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.report.browser import CHROMIUM, Browser, Tab

PLACE = "(own => [own.x + scrollX, own.y + scrollY, own.width, own.height])"
SETTLED = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
MARGIN = 8


def main() -> None:
    """Read the command line and write the picture."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--part", default="html", help="selector of what is shown")
    parser.add_argument("--at", default="", help="fragment of the address")
    parser.add_argument("--width", type=int, default=1300, help="of the window, in pixels")
    parser.add_argument("--dark", action="store_true")
    given = parser.parse_args()
    address = given.page.resolve().as_uri() + f"#{given.at}" * bool(given.at)
    assert CHROMIUM is not None, "there is no Chromium here"
    with TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(CHROMIUM, Path(profile))
        try:
            tab = Tab(browser, address, given.width, "dark" if given.dark else "light")
            given.picture.write_bytes(picture(tab, given.part))
        finally:
            browser.close()


def picture(tab: Tab, part: str) -> bytes:
    """The first element of this selector, as PNG, in a window as high as the page."""
    width, height = tab.evaluate("[innerWidth, document.documentElement.scrollHeight]")
    screen = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    tab.call("Emulation.setDeviceMetricsOverride", **screen)
    tab.evaluate(SETTLED)
    element = f"document.querySelector({part!r})"
    x, y, width, height = tab.evaluate(f"{PLACE}({element}.getBoundingClientRect())")
    clip = {"x": max(0, x - MARGIN), "y": max(0, y - MARGIN), "scale": 1}
    clip |= {"width": width + 2 * MARGIN, "height": height + 2 * MARGIN}
    return b64decode(tab.call("Page.captureScreenshot", format="png", clip=clip)["data"])


if __name__ == "__main__":
    main()
