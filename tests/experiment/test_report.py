"""The report: one self-contained file that tells every trial, readable by anyone."""

import json
import shlex
from html.parser import HTMLParser
from pathlib import Path

import pytest

from testbed.experiment.record import At, Attempt, Explained, Occurrence
from testbed.experiment.report import SHOWN, timeline, write_report
from testbed.experiment.store import TrialWriter
from tests.experiment.samples import a_record

LOADING = {"src", "srcset", "action", "poster", "data"}
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
        self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())


def _report(folder: Path, *records: object) -> tuple[str, Page]:
    with TrialWriter(folder) as writer:
        for record in records:
            writer.append(record)  # type: ignore[arg-type]
    write_report(folder, "tiny")
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
        (
            4,
            "mental",
            "wait",
            "",
            "exception -home, shift at step 2, false news of shift at step 3",
        ),
        (5, "mental", "finish", "", ""),
    ]


def test_the_report_is_one_file_that_loads_nothing(tmp_path: Path) -> None:
    text, page = _report(tmp_path, a_record("a"), a_record("b", outcome="gave_up", achieved=False))
    assert page.open == []
    assert all(address.startswith(("data:", "#")) for address in page.addresses)
    assert not {"script", "iframe", "object"} & set(page.tags)
    assert "http" not in text
    assert "url(" not in text


def test_the_report_suits_dark_rooms_and_narrow_screens(tmp_path: Path) -> None:
    text, _ = _report(tmp_path, a_record("a"))
    assert "prefers-color-scheme: dark" in text
    assert 'name="viewport"' in text
    assert "overflow-x: auto" in text


def test_a_script_that_was_not_played_to_its_end_is_said_under_the_table(tmp_path: Path) -> None:
    reason = "script step 50 was not reached"
    _, page = _report(tmp_path, a_record("a", reason=reason), a_record("b"))
    assert f"scenario 1, intentional: {reason} in 1 of 2 trials." in page.text


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
    told = page.text
    assert all(f"--trial bad{number}" in told for number in range(3))
    assert told.count("--trial") == SHOWN
    assert f"{SHOWN} of {SHOWN + 23} trials" in told


def test_the_summary_is_written_beside_it(tmp_path: Path) -> None:
    _report(tmp_path, a_record("a"))
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["trials"] == 1
    assert summary["scenarios"]["1"]["accuracy"] == {"intentional": 1.0}
