"""A damaged run is told with the line, and repaired: what is whole is kept, and nothing else."""

import json
import re
import shutil
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result
from typer.testing import CliRunner

from testbed.cli import app

RUN = ("run", "quickstart", "scenarios=[1,2]", "link=inprocess", "--quiet", "--out")
Lines = list[bytes]
SEAL = ("version", "crc32")


def _do(*arguments: object) -> Result:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of four trials."""
    folder = tmp_path_factory.mktemp("whole") / "run"
    assert _do(*RUN, folder).exit_code == 0
    return folder


def _keys(line: bytes) -> dict[str, object]:
    """A line as testbeds wrote it before lines had a version and a checksum."""
    return {key: value for key, value in json.loads(line).items() if key not in SEAL}


def _with(line: bytes, **keys: object) -> bytes:
    return json.dumps(_keys(line) | keys).encode() + b"\n"


def _changed(line: bytes) -> bytes:
    """A record like any other, but not the one that was written."""
    return re.sub(rb'"seed":(\d)', lambda found: b'"seed":%d' % ((int(found[1]) + 1) % 10), line)


DAMAGES: dict[str, tuple[Callable[[Lines], Lines], list[int]]] = {
    "no record": (lambda own: [own[0], b"nonsense\n", *own[2:]], [2]),
    "torn": (lambda own: [*own[:3], own[3][:50]], [4]),
    "the same again": (lambda own: [*own, own[0]], [5]),
    "the same in another time": (lambda own: [*own, _with(own[0], wall_time_s=7.5)], [5]),
    "another result": (lambda own: [*own, _with(own[1], plans=9)], [2, 5]),
    "another result, twice": (lambda own: [own[1], *own, _with(own[1], plans=9)], [1, 3, 6]),
    "a stranger": (lambda own: [*own, _with(own[0], trial="0" * 16)], [5]),
    "another seed": (lambda own: [*own[:2], _with(own[2], seed=4), own[3]], [3]),
    "steps after the last": (lambda own: [*own[:3], _with(own[3], steps=2**31 - 1)], [4]),
    "a digit": (lambda own: [own[0], _changed(own[1]), *own[2:]], [2]),
    "another order": (
        lambda own: [own[0], json.dumps(json.loads(own[1])).encode() + b"\n", *own[2:]],
        [2],
    ),
    "another goal": (lambda own: [*own[:3], _with(own[3], goal=["loc(book1,kitchen)"])], [4]),
}


@pytest.fixture(params=DAMAGES)
def damaged(request: pytest.FixtureRequest, whole: Path, tmp_path: Path) -> tuple[Path, list[int]]:
    """A copy of the run that is damaged, and the lines that are not whole."""
    damage, lines = DAMAGES[request.param]
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    trials = folder / "trials.jsonl"
    trials.write_bytes(b"".join(damage(trials.read_bytes().splitlines(keepends=True))))
    return folder, lines


def test_damage_is_told_in_one_line_with_its_place(damaged: tuple[Path, list[int]]) -> None:
    folder, lines = damaged
    before = (folder / "trials.jsonl").read_bytes()
    if not before.endswith(b"\n"):  # a torn last line is dropped without a word: it was not written
        lines = []
    for command in (("report", folder), (*RUN, folder, "--resume")):
        told = _do(*command)
        assert told.exit_code == (2 if lines else 0)
        if lines:
            assert len(told.stderr.splitlines()) == 1
            number = int(re.findall(r"trials\.jsonl:(\d+):", told.stderr)[0])
            assert number in lines
            assert (folder / "trials.jsonl").read_bytes() == before


def test_what_is_whole_is_kept(damaged: tuple[Path, list[int]]) -> None:
    folder, lines = damaged
    trials = folder / "trials.jsonl"
    before = trials.read_bytes()
    repaired = _do("repair", folder)
    assert repaired.exit_code == 0
    told = [int(number) for number in re.findall(r"trials\.jsonl:(\d+):", repaired.stdout)]
    assert told == lines
    own = before.splitlines(keepends=True)
    kept = [line for number, line in enumerate(own, start=1) if number not in lines]
    assert trials.read_bytes() == b"".join(kept)
    assert (folder / "trials.jsonl.damaged").read_bytes() == before
    assert _do("report", folder).exit_code == 0


def test_a_repaired_run_goes_on_to_the_same_results(whole: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    trials = folder / "trials.jsonl"
    own = trials.read_bytes().splitlines(keepends=True)
    trials.write_bytes(b"".join([own[0], b"\xff\n", own[2], own[3], own[2]]))
    assert _do("repair", folder).exit_code == 0
    assert _do(*RUN, folder, "--resume").exit_code == 0
    digests = [json.loads((run / "summary.json").read_text())["digest"] for run in (whole, folder)]
    assert digests[0] == digests[1]


def test_where_nothing_is_damaged_nothing_changes(whole: Path) -> None:
    before = {path: path.read_bytes() for path in whole.iterdir() if path.is_file()}
    assert _do("repair", whole).exit_code == 0
    assert {path: path.read_bytes() for path in whole.iterdir() if path.is_file()} == before


def test_a_second_damage_does_not_overwrite_what_the_first_left(
    whole: Path, tmp_path: Path
) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    trials = folder / "trials.jsonl"
    for nonsense in (b"one\n", b"two\n"):
        trials.write_bytes(trials.read_bytes() + nonsense)
        assert _do("repair", folder).exit_code == 0
    old = [path.read_bytes() for path in folder.glob("trials.jsonl.damaged*")]
    assert sorted(text.splitlines()[-1] for text in old) == [b"one", b"two"]


def test_what_is_no_run_is_not_repaired(tmp_path: Path) -> None:
    refused = _do("repair", tmp_path)
    assert (refused.exit_code, len(refused.stderr.splitlines())) == (2, 1)
    assert str(tmp_path) in refused.stderr


@pytest.mark.parametrize(
    "line", [b'{"trial": "%s"}', b'{"x": %s, "trial": "%%s"}' % (b"[" * 10**5 + b"]" * 10**5)]
)
def test_what_is_damaged_of_a_retry_takes_no_place(
    whole: Path, tmp_path: Path, line: bytes
) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    before = (folder / "trials.jsonl").read_bytes()
    trial = json.loads(before.splitlines()[0])["trial"]
    (folder / "retries.jsonl").write_bytes(line % trial.encode() + b"\n")
    assert _do("repair", folder).exit_code == 0
    assert (folder / "trials.jsonl").read_bytes() == before
    assert not (folder / "retries.jsonl").exists()


def test_a_retry_takes_the_place_of_a_record_with_a_damaged_version(
    whole: Path, tmp_path: Path
) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    trials, before = folder / "trials.jsonl", (folder / "trials.jsonl").read_bytes()
    (folder / "retries.jsonl").write_bytes(before.splitlines(keepends=True)[0])
    trials.write_bytes(re.sub(rb'"version":\d+', b'"version":"?"', before, count=1))
    assert _do("repair", folder).exit_code == 0
    assert trials.read_bytes() == before


def test_a_retry_whose_records_are_gone_is_repaired(whole: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    (folder / "trials.jsonl").rename(folder / "retries.jsonl")
    repaired = _do("repair", folder)
    (told,) = repaired.stderr.splitlines()
    assert repaired.exit_code == 0
    assert "retries.jsonl" in told
    assert "and 3 more" in told
    assert _do(*RUN, folder, "--resume").exit_code == 0
    assert len((folder / "trials.jsonl").read_bytes().splitlines()) == 4


def test_each_line_has_a_version_and_the_checksum_of_its_rest(whole: Path) -> None:
    for line in (whole / "trials.jsonl").read_bytes().splitlines():
        own = json.loads(line)
        assert list(own)[:2] == list(SEAL)
        rest = line[line.index(b'"trial"') :]
        assert int(own["crc32"], 16) == zlib.crc32(b"{" + rest)


def test_records_without_version_and_checksum_are_read(whole: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    trials = folder / "trials.jsonl"
    older = [_with(line) for line in trials.read_bytes().splitlines(keepends=True)]
    trials.write_bytes(b"".join(older))
    for command in (("report", folder), (*RUN, folder, "--resume"), ("repair", folder)):
        assert _do(*command).exit_code == 0
    assert trials.read_bytes() == b"".join(older)
    digests = [json.loads((run / "summary.json").read_text())["digest"] for run in (whole, folder)]
    assert digests[0] == digests[1]


@pytest.mark.parametrize("name", ["trials.jsonl", "retries.jsonl"])
def test_records_of_a_newer_version_are_refused_and_kept(
    whole: Path, tmp_path: Path, name: str
) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    newer = re.sub(rb'"version":\d+', b'"version":999', (folder / "trials.jsonl").read_bytes())
    (folder / name).write_bytes(newer)
    for command in (("repair", folder), (*RUN, folder, "--resume")):
        told = _do(*command)
        assert (told.exit_code, len(told.stderr.splitlines())) == (2, 1)
        assert f"{name}:1:" in told.stderr
        assert "999" in told.stderr
        assert (folder / name).read_bytes() == newer
