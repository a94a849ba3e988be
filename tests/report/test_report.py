"""The report: one self-contained file that tells every trial, readable by anyone."""

import json
import os
import re
import shlex
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

from testbed.config import load_config
from testbed.experiment.record import At, Attempt, Explained, Occurrence
from testbed.experiment.store import TrialWriter
from testbed.experiment.timeline import timeline
from testbed.report import SHOWN, write_report
from tests.experiment.samples import a_record

pytestmark = pytest.mark.versions

LOADING = {"src", "srcset", "action", "poster", "data"}
ROOT = Path(__file__).parents[2]
NAMESPACE = "http://www.w3.org/2000/svg"
"""The name of a vocabulary, which nobody asks for."""
VOID = {"meta", "link", "br", "img", "hr", "input"}


class Page(HTMLParser):
    """What a page contains, and whether its elements are closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[str] = []
        self.addresses: list[str] = []
        self.words: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.addresses += [v or "" for k, v in attrs if k in LOADING or k == "href"]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not {"script", "style"}.intersection(self.open):
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())


def _report(folder: Path, *records: object) -> tuple[str, Page]:
    with TrialWriter(folder) as writer:
        for record in records:
            writer.append(record)  # type: ignore[arg-type]
    write_report(folder, load_config("office", ["name=tiny", "seed=7"]))
    text = (folder / "report.html").read_text(encoding="utf-8")
    return text, Page(text)


def test_a_timeline_has_every_step_with_who_did_what() -> None:
    record = a_record(
        steps=5,
        actions=[Attempt(2, "go", True), Attempt(3, "take", False)],
        exogenous=[Occurrence(2, "shift", False)],
        explanations=[Explained(4, [At(2, "shift")], ["-home"], [At(3, "shift")])],
        mental=[At(1, "start(1)"), At(5, "finish")],
    )
    told = [(s.number, s.kind, s.robot, s.others, s.explained) for s in timeline(record)]
    assert told == [
        (1, "mental", "start(1)", "", ""),
        (2, "done", "go", "shift, unseen", ""),
        (3, "failed", "take failed", "", ""),
        (4, "mental", "wait", "", "exception -home, shift at step 2, distrusted shift at step 3"),
        (5, "mental", "finish", "", ""),
    ]


def test_the_report_is_one_file_that_loads_nothing(tmp_path: Path) -> None:
    text, page = _report(tmp_path, a_record("a"), a_record("b", outcome="gave_up", achieved=False))
    assert page.open == []
    assert all(address.startswith(("data:", "#")) for address in page.addresses)
    assert not {"iframe", "object"} & set(page.tags)
    assert "http" not in text.replace(NAMESPACE, "")
    assert "url(" not in text


def test_the_report_suits_dark_rooms_and_narrow_screens(tmp_path: Path) -> None:
    text, _ = _report(tmp_path, a_record("a"))
    assert "prefers-color-scheme: dark" in text
    assert 'name="viewport"' in text
    assert "overflow-x: auto" in text


def test_a_script_that_was_not_played_to_its_end_is_said_under_the_table(tmp_path: Path) -> None:
    reason = "script step 50 was not reached"
    _, page = _report(tmp_path, a_record("a", reason=reason), a_record("b"))
    assert re.search(rf"scenario 1, intentional: {reason}\D*1\D+2\D", page.text)


def test_the_heading_says_what_was_run_and_what_the_domain_says_of_a_scenario(
    tmp_path: Path,
) -> None:
    _, page = _report(tmp_path, a_record("a", scenario="6"))
    head, _, rest = page.text.partition("What the robots achieved")
    assert "tiny domain office seed 7 robots intentional, traditional trials 1" in head
    assert "Failure to execute: the library is locked" in rest.partition("Scenario 6")[2]


def test_robots_are_compared_where_both_have_played(tmp_path: Path) -> None:
    (tmp_path / "alone").mkdir()
    (tmp_path / "both").mkdir()
    intentional = a_record("a", pair="one", action_count=4)
    traditional = a_record("b", pair="one", robot="traditional", action_count=10, correct=False)
    _, alone = _report(tmp_path / "alone", intentional)
    assert "How they compare" not in alone.text
    _, both = _report(tmp_path / "both", intentional, traditional)
    table = both.text.partition("How they compare")[2].partition("Behind the shares")[0]
    assert "1 1 100.0 % 0.0 % 1 - - - - 2.50" in table


def test_text_does_not_break_inside_of_an_atom(tmp_path: Path) -> None:
    explanation = Explained(2, [At(1, "exo_move(book2,library)")], ["-loc(book1,kitchen)"])
    text, _ = _report(tmp_path, a_record(steps=2, explanations=[explanation]))
    for atom in ("exo_move(book2,library)", "-loc(book1,kitchen)", "loc(book1,library)"):
        assert f'<span class="atom">{atom}' in text
    assert "overflow-wrap: anywhere" not in text


def test_on_a_narrow_screen_every_cell_has_its_label(tmp_path: Path) -> None:
    text, page = _report(tmp_path, a_record(steps=2), a_record("b", robot="traditional", steps=2))
    rows = text.count('<th scope="row"')
    assert page.tags.count("td") + rows == text.count("<td ") + rows == text.count("data-label=")
    assert page.tags.count("table") == text.count('stack">') == 5


def test_the_same_records_give_the_same_page(tmp_path: Path) -> None:
    events = [At(step, f"exo_move(book{step},kitchen)") for step in range(1, 9)]
    text, _ = _report(tmp_path, a_record(explanations=[Explained(9, events, ["b", "a"])]))
    program = (
        "import sys; from pathlib import Path; from testbed.config import load_config; "
        "from testbed.report import write_report; "
        "write_report(Path(sys.argv[1]), load_config('office', ['name=tiny', 'seed=7']))"
    )
    for seed in ("1", "2"):
        environment = os.environ | {"PYTHONHASHSEED": seed}
        command = [sys.executable, "-c", program, str(tmp_path)]
        subprocess.run(command, check=True, env=environment, cwd=ROOT)
        assert (tmp_path / "report.html").read_text(encoding="utf-8") == text


def test_what_comes_from_outside_is_escaped(tmp_path: Path) -> None:
    reason = "<script>alert(1)</script>"
    text, page = _report(tmp_path, a_record(outcome="error", achieved=False, reason=reason))
    assert reason not in text
    assert reason in page.text


@pytest.mark.parametrize("folder", ["runs/mine", "my runs/mine", "runs/o'clock"])
def test_a_trial_is_told_with_the_command_that_replays_it(at_home: Path, folder: str) -> None:
    (at_home / folder).mkdir(parents=True)
    _, page = _report(Path(folder), a_record("cafe42"))
    command = f"testbed replay {shlex.quote(folder)} --trial cafe42"
    assert shlex.split(command)[2] == folder
    assert command in page.text


def test_of_many_trials_the_failures_are_told_first(tmp_path: Path) -> None:
    good = [a_record(f"good{number}") for number in range(SHOWN + 20)]
    bad = [a_record(f"bad{number}", achieved=False, outcome="gave_up") for number in range(3)]
    _, page = _report(tmp_path, *good, *bad)
    told = page.text.partition("someone else acted")[2].partition("The slowest trials")[0]
    assert all(f"--trial bad{number}" in told for number in range(3))
    assert told.count("--trial") == SHOWN
    assert re.search(rf"\b{SHOWN}\D+{SHOWN + 23}\b", page.text)


def test_the_summary_is_written_beside_it(tmp_path: Path) -> None:
    _report(tmp_path, a_record("a"))
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["trials"] == 1
    assert summary["scenarios"]["1"]["accuracy"] == {"intentional": 1.0}
