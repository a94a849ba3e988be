"""The command that plays a protocol in several ways, at a small size, and what it says of it."""

import re
from pathlib import Path

import pytest

from benchmarks import digests
from benchmarks.digests import WAYS, Way, main
from benchmarks.killing import NotKilledError, killed_at, whole_lines
from benchmarks.sheets import Row
from testbed.experiment.digest import digest
from testbed.experiment.store import read_records

SMALL = ("levels", "levels=[L1,L3]", "limit=1")


def _digests(page: str) -> list[str]:
    """Those in the sections of a page, one per way."""
    sections = page[page.index("\n## ") :]
    return re.findall(r"`([0-9a-f]{64})`", sections)


def test_a_protocol_has_one_digest_however_it_is_played(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two of the ways: that the others give the same is tested with the protocols."""
    first, *_, killed = WAYS
    monkeypatch.setattr(digests, "WAYS", (first, killed))
    runs, page = tmp_path / "runs", tmp_path / "page.md"
    assert main([*SMALL, "--folder", str(runs), "--page", str(page)]) == 0
    records = [list(read_records(runs / "levels" / way.name)) for way in (first, killed)]
    assert [len(played) for played in records] == [4, 4]
    written = page.read_text(encoding="utf-8")
    assert _digests(written) == [digest(played) for played in records]
    assert len(set(_digests(written))) == 1
    assert re.search("killed with 2 trials on record", written)
    assert "The digests of a protocol are equal." in written
    assert "levels: one digest" in capsys.readouterr().out


def _other_when_killed(way: Way, what: object, folder: Path, planned: int) -> Row:
    del what, folder
    return {
        "workers": way.workers,
        "link": way.link,
        "killed_after": planned // 2 if way.killed else None,
        "trials": planned,
        "failed": 0,
        "minutes": 0.0,
        "revision": None,
        "digest": ("b" if way.killed else "a") * 64,
    }


def test_results_that_differ_are_said_to_and_give_exit_code_1(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(digests, "_played", _other_when_killed)
    page = tmp_path / "page.md"
    assert main([*SMALL, "--page", str(page)]) == 1
    assert "levels: 2 digests: the results differ" in capsys.readouterr().out
    assert "**The results of levels differ.**" in page.read_text(encoding="utf-8")


def test_bad_input_costs_a_line_and_exit_code_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["levls"]) == 2
    assert "did you mean 'levels'?" in capsys.readouterr().err
    (tmp_path / "levels" / "one").mkdir(parents=True)
    assert main([*SMALL, "--folder", str(tmp_path)]) == 2
    assert "levels/one: is there already" in capsys.readouterr().err


def test_a_driver_that_ends_by_itself_was_not_killed(tmp_path: Path) -> None:
    with pytest.raises(NotKilledError, match="ended before"):
        killed_at(1, ["check", "quickstart"], tmp_path)


def test_a_torn_line_is_not_among_the_whole_ones(tmp_path: Path) -> None:
    path = tmp_path / "lines"
    path.write_text("a\nb\nto", encoding="utf-8")
    assert whole_lines(path) == b"a\nb\n"


def test_the_page_of_the_documents_has_one_digest_a_protocol() -> None:
    root = Path(digests.__file__).parents[1]
    page = (root / "docs" / "digests.md").read_text(encoding="utf-8")
    _, *sections = page.split("\n## ")
    assert [section.split()[0] for section in sections] == ["table1", "levels"]
    for section in sections:
        assert len(_digests(f"\n## {section}")) == len(WAYS)
        assert len(set(_digests(f"\n## {section}"))) == 1
