"""Stories are kept in the run folder whoever plays, and a run is whole without them."""

import json
import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

from testbed.cli import app
from testbed.config import load_config
from testbed.experiment import run
from testbed.experiment.live_run import LiveRun
from testbed.experiment.run_folder import read_config
from testbed.experiment.shard import Shard
from testbed.experiment.stories import Story, StoryFile, decode
from tests.pots import write_pots

STORIES = "stories.jsonl"


def _invoke(*arguments: str) -> tuple[int, str]:
    done = CliRunner().invoke(app, list(arguments))
    return done.exit_code, done.stdout


def _records(folder: Path) -> list[dict[str, object]]:
    return [json.loads(line) for line in (folder / "trials.jsonl").read_bytes().splitlines()]


def _stories(folder: Path) -> dict[str, Story]:
    """Those of all trials on record."""
    return StoryFile(folder).of(str(record["trial"]) for record in _records(folder))


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run, with the file of its configuration beside it."""
    folder = tmp_path_factory.mktemp("played")
    run(load_config(write_pots(folder / "beside")), folder / "run", workers=0)
    return folder


@pytest.fixture
def copied(played: Path, tmp_path: Path) -> Path:
    """A copy, to be changed."""
    shutil.copytree(played, tmp_path / "copy")
    return tmp_path / "copy" / "run"


def _resume(folder: Path) -> None:
    run(load_config(folder.parent / "beside" / "pots.yaml"), folder, workers=0, resume=True)


def test_each_trial_on_record_has_its_story(played: Path) -> None:
    stories = _stories(played / "run")
    assert len(stories) == 36
    for record in _records(played / "run"):
        steps = stories[str(record["trial"])].steps
        assert [step.step for step in steps] == list(range(1, int(str(record["steps"])) + 1))
        events = [{"step": own.step, "action": own.event} for own in steps if own.event]
        assert events == [
            {"step": own["step"], "action": own["action"]}
            for own in record["exogenous"]  # type: ignore[attr-defined]
        ]


@pytest.mark.parametrize(("runner", "workers"), [("local", 2), ("dask", 2)])
def test_stories_are_the_same_of_any_runner(
    played: Path, tmp_path: Path, runner: str, workers: int
) -> None:
    config = load_config(played / "beside" / "pots.yaml", [f"runner={runner}"])
    run(config, tmp_path / "run", workers)
    assert _stories(tmp_path / "run") == _stories(played / "run")


def test_stories_of_parts_are_merged_with_them(played: Path, tmp_path: Path) -> None:
    config = load_config(played / "beside" / "pots.yaml")
    parts = [tmp_path / f"part-{number}" for number in (1, 2)]
    for number, part in enumerate(parts, start=1):
        run(config, part, workers=0, shard=Shard(number, 2))
    (parts[0] / STORIES).write_bytes((parts[0] / STORIES).read_bytes() + b'{"trial":"torn')
    assert _invoke("merge", *map(str, parts), "-o", str(tmp_path / "merged"))[0] == 0
    assert _stories(tmp_path / "merged") == _stories(played / "run")
    (parts[1] / STORIES).unlink()
    assert _invoke("merge", *map(str, parts), "-o", str(tmp_path / "again"))[0] == 0
    assert _stories(tmp_path / "again") == _stories(parts[0])


def test_a_run_without_stories_is_whole(copied: Path) -> None:
    (copied / STORIES).unlink()
    assert _stories(copied) == {}
    assert _invoke("report", str(copied))[0] == 0
    _resume(copied)
    assert _stories(copied) == {}


def test_a_run_that_goes_on_drops_a_torn_story_and_plays_what_is_missing(
    played: Path, copied: Path
) -> None:
    lines = (copied / "trials.jsonl").read_bytes().splitlines(keepends=True)
    (copied / "trials.jsonl").write_bytes(b"".join(lines[:5]))
    told = (copied / STORIES).read_bytes().splitlines(keepends=True)
    (copied / STORIES).write_bytes(b"".join(told[:7]) + told[7][:80])
    assert len(_stories(copied)) == 5
    _resume(copied)
    assert _stories(copied) == _stories(played / "run")
    kept = (copied / STORIES).read_bytes().splitlines(keepends=True)
    assert kept[:7] == told[:7]
    assert len(kept) == 7 + 36 - 5, "those of the two that were not on record are told again"


def test_of_a_trial_that_is_told_twice_the_last_story_counts(copied: Path) -> None:
    (record, *_) = _records(copied)
    trial = str(record["trial"])
    with (copied / STORIES).open("ab") as file:
        file.write(b'{"trial":"%s","steps":[{"step":1,"action":"wait"}]}\n' % trial.encode())
    assert [step.action for step in _stories(copied)[trial].steps] == ["wait"]


@pytest.mark.parametrize("numbers", [(2**31 - 1,), (-1,), (1, 2**31 - 1), (1, 3), (2, 1), (1, 1)])
def test_a_story_whose_steps_do_not_follow_each_other_is_none(
    copied: Path, numbers: tuple[int, ...]
) -> None:
    """Its trial is shown by its record; a page of what is told there would have no end."""
    (record, *_) = _records(copied)
    trial = str(record["trial"])
    told = {"trial": trial, "steps": [{"step": own, "action": "wait"} for own in numbers]}
    with (copied / STORIES).open("ab") as file:
        file.write(json.dumps(told, separators=(",", ":")).encode() + b"\n")
    assert trial not in _stories(copied)
    assert _invoke("report", str(copied))[0] == 0
    page = (copied / "report.html").read_text(encoding="utf-8")
    shown = json.loads(page.partition('id="explorer-data">')[2].partition("</script>")[0])
    (own,) = [one for one in shown["trials"] if one["id"] == trial]
    assert [step["step"] for step in own["story"]] == [*range(1, int(str(record["steps"])) + 2)]


def test_stories_are_read_on_as_they_come(copied: Path) -> None:
    lines = (copied / STORIES).read_bytes().splitlines(keepends=True)
    (copied / STORIES).unlink()
    file, stories = StoryFile(copied), [decode(line) for line in lines]
    first, second, third = (story.trial for story in stories[:3])
    assert file.get(first) is None
    (copied / STORIES).write_bytes(lines[0] + lines[1][:50])
    file.look()
    assert (first in file, second in file) == (True, False)
    with (copied / STORIES).open("ab") as written:
        written.write(lines[1][50:])
    file.look()
    assert [file.get(trial) for trial in (first, second, third)] == [*stories[:2], None]


def test_of_a_file_that_was_replaced_no_other_story_is_told(copied: Path) -> None:
    lines = (copied / STORIES).read_bytes().splitlines(keepends=True)
    file, trial = StoryFile(copied), decode(lines[0]).trial
    (copied / STORIES).write_bytes(b"".join(lines[1:]))
    assert file.get(trial) is None
    (copied / STORIES).unlink()
    assert file.get(trial) is None


def test_repair_keeps_the_stories_that_are_whole(copied: Path, played: Path) -> None:
    told = (copied / STORIES).read_bytes().splitlines(keepends=True)
    other = told[3].replace(b'"step":1,', b'"step":"one",')
    (copied / STORIES).write_bytes(
        b"".join([told[0], b"nonsense\n", other, *told[4:], told[2][:9]])
    )
    first, *_, last = _stories(played / "run")
    assert set(_stories(copied)) < set(_stories(played / "run"))
    code, said = _invoke("repair", str(copied))
    assert code == 0
    (line,) = [line for line in said.splitlines() if STORIES in line]
    assert " 3 lines " in line
    assert (copied / STORIES).read_bytes() == b"".join([told[0], *told[4:]])
    assert {first, last} <= set(_stories(copied))
    assert STORIES not in _invoke("repair", str(copied))[1]


def test_a_trial_that_is_lost_has_the_story_of_its_last_attempt(
    played: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A robot that breaks at its third step: two are told, and all of them when it is mended."""
    monkeypatch.chdir(tmp_path)
    (played / "beside" / "breaking_robots.py").write_text(BREAKING, encoding="utf-8")
    given = ["run", str(played / "beside" / "pots.yaml"), "repeats=1", "limits.steps=5"]
    given += ["robots=[breaking_robots:Breaking]", "--out", "run", "--quiet"]
    Path("broken").touch()
    assert _invoke(*given)[0] == 1
    assert {len(story.steps) for story in _stories(tmp_path / "run").values()} == {2}
    assert {record["outcome"] for record in _records(tmp_path / "run")} == {"robot_lost"}
    live = LiveRun(tmp_path / "run", read_config(tmp_path / "run"))
    live.look()
    assert (live.status.done, live.status.failed) == (9, 9)
    Path("broken").unlink()
    assert _invoke(*given, "--resume", "--retry-failed")[0] == 0
    assert {len(story.steps) for story in _stories(tmp_path / "run").values()} == {5}
    live.look()
    assert (live.status.done, live.status.failed) == (9, 0), "new records took the old ones' places"
    (counts,) = live.outcomes.values()
    assert +counts == {"step_limit": 9}


BREAKING = """\
from pathlib import Path

from testbed.protocol import Capabilities, Decision, Trace


class Breaking:
    capabilities = Capabilities()

    def begin(self, task):
        pass

    def act(self, percept):
        if percept.step == 3 and Path("broken").exists():
            raise RuntimeError("broken")
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action="wait",
            believes_goal=False,
            trace=Trace(),
        )
"""
