"""The run folder: what is written stays, what is torn is dropped, what is changed is refused."""

import subprocess
import sys
from pathlib import Path

import pytest
import yaml

import asp
from testbed.config import AdversarySettings, ExperimentConfig, Limits, load_config
from testbed.experiment import StoreError
from testbed.experiment.lock import locked
from testbed.experiment.plan import plan_trials
from testbed.experiment.run_folder import (
    check_unchanged,
    choose_folder,
    config_text,
    read_config,
    replace_text,
    write_config,
)
from testbed.experiment.store import TrialWriter, decode, encode, read_records
from tests.experiment.samples import Configure, a_record, ids


def _write(folder: Path, *trials: str) -> None:
    with TrialWriter(folder) as writer:
        for trial in trials:
            writer.append(a_record(trial))


def test_the_configuration_is_told_with_every_key(tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text('name: own\ngoal: ["loc(book1,library)"]\nscenario_settings: {1: {script: []}}')
    told = yaml.safe_load(config_text(load_config(path)))
    assert list(told) == list(ExperimentConfig.model_fields)
    assert told["initial"] is told["limit"] is told["script"] is None
    assert (told["seed"], told["robots"]) == (0, ["intentional", "traditional"])
    assert list(told["limits"]) == list(Limits.model_fields)
    assert list(told["adversary"]) == list(AdversarySettings.model_fields)
    assert told["scenario_settings"] == {"1": {"script": []}}


def test_a_record_reads_back_as_it_was_written() -> None:
    record = a_record("x", planning_time_s=0.25, reason="no answer", achieved=False)
    assert decode(encode(record)) == record
    assert encode(record).count(b"\n") == 1


def test_records_are_readable_while_the_file_grows(tmp_path: Path) -> None:
    with TrialWriter(tmp_path) as writer:
        writer.append(a_record("a"))
        assert ids(list(read_records(tmp_path))) == ["a"]
        writer.append(a_record("b"))
        assert ids(list(read_records(tmp_path))) == ["a", "b"]


@pytest.mark.parametrize("kept", [0, 1, 10, -1])
def test_a_torn_last_line_is_dropped_and_written_anew(tmp_path: Path, kept: int) -> None:
    _write(tmp_path, "a", "b")
    whole = (tmp_path / "trials.jsonl").read_bytes()
    first, torn, _ = whole.split(b"\n")
    (tmp_path / "trials.jsonl").write_bytes(first + b"\n" + torn[:kept])
    assert ids(list(read_records(tmp_path))) == ["a"]
    with TrialWriter(tmp_path) as writer:
        assert writer.done == {"a"}
        writer.append(a_record("b"))
    assert (tmp_path / "trials.jsonl").read_bytes() == whole


def test_a_file_that_is_nothing_but_torn_starts_again(tmp_path: Path) -> None:
    (tmp_path / "trials.jsonl").write_bytes(b'{"trial":"a"')
    with TrialWriter(tmp_path) as writer:
        assert writer.done == set()
    assert (tmp_path / "trials.jsonl").read_bytes() == b""


def test_damage_in_the_middle_is_reported_with_its_line(tmp_path: Path) -> None:
    _write(tmp_path, "a", "b", "c")
    lines = (tmp_path / "trials.jsonl").read_bytes().splitlines(keepends=True)
    (tmp_path / "trials.jsonl").write_bytes(lines[0] + b"nonsense\n" + lines[2])
    with pytest.raises(StoreError, match=r"trials\.jsonl:2: not a record"):
        list(read_records(tmp_path))


def test_a_folder_has_one_writer(tmp_path: Path) -> None:
    with locked(tmp_path), pytest.raises(StoreError, match=str(tmp_path)), locked(tmp_path):
        raise AssertionError("unreachable")
    with locked(tmp_path):
        _write(tmp_path, "a")


def test_a_writer_killed_leaves_the_folder_free(tmp_path: Path) -> None:
    program = (
        "import os, signal, sys; from pathlib import Path;"
        "from testbed.experiment.lock import locked;"
        "locked(Path(sys.argv[1])).__enter__(); os.kill(os.getpid(), signal.SIGKILL)"
    )
    killed = subprocess.run([sys.executable, "-c", program, str(tmp_path)], check=False)
    assert killed.returncode == -9
    with locked(tmp_path):
        _write(tmp_path, "a")


@pytest.mark.usefixtures("at_home")
def test_runs_of_one_name_get_folders_of_their_own() -> None:
    first = choose_folder(None, "tiny", resume=False)
    second = choose_folder(None, "tiny", resume=False)
    assert choose_folder(None, "tiny", resume=True) == second
    third = choose_folder(None, "tiny", resume=False)
    assert [first, second, third] == [Path("runs") / n for n in ("tiny", "tiny-2", "tiny-3")]
    assert choose_folder(None, "another", resume=True) == Path("runs/another")


def test_a_named_folder_with_a_run_is_only_resumed(tmp_path: Path) -> None:
    assert choose_folder(tmp_path, "tiny", resume=False) == tmp_path
    _write(tmp_path, "a")
    assert choose_folder(tmp_path, "tiny", resume=True) == tmp_path
    with pytest.raises(StoreError, match="--resume"):
        choose_folder(tmp_path, "tiny", resume=False)
    with pytest.raises(StoreError, match="not a folder"):
        choose_folder(tmp_path / "trials.jsonl", "tiny", resume=True)


def test_the_stored_configuration_is_the_one_that_ran(tmp_path: Path, configure: Configure) -> None:
    config = configure("limit=1", "adversary.rate=0.5")
    write_config(tmp_path, config)
    assert read_config(tmp_path) == config
    check_unchanged(tmp_path, config)
    planned = [spec.trial for spec in plan_trials(config)]
    assert [spec.trial for spec in plan_trials(read_config(tmp_path))] == planned


def test_a_changed_configuration_is_refused_with_the_difference(
    tmp_path: Path, configure: Configure
) -> None:
    write_config(tmp_path, configure())
    changed = configure("seed=5", "limits.steps=50", "scenario_settings.4.goal_feedback=false")
    with pytest.raises(StoreError) as refusal:
        check_unchanged(tmp_path, changed)
    assert [line.strip() for line in str(refusal.value).splitlines()[1:]] == [
        "seed: 1 -> 5",
        "limits.steps: 100 -> 50",
        "scenario_settings.4.goal_feedback: absent -> False",
    ]


def test_where_the_robot_runs_may_change(tmp_path: Path, configure: Configure) -> None:
    write_config(tmp_path, configure("link=zenoh"))
    check_unchanged(tmp_path, configure("link=inprocess", "limits.answer_s=1.5"))


def test_a_domain_of_ones_own_is_kept_with_the_run(tmp_path: Path) -> None:
    source, run = tmp_path / "own.al", tmp_path / "run"
    source.write_text(asp.load_description("office").source, encoding="utf-8")
    config = load_config("quickstart", [f"domain={source}"])
    write_config(run, config)
    check_unchanged(run, config)
    assert Path(read_config(run).domain) == (run / "own.al").resolve()
    check_unchanged(run, read_config(run))
    source.write_text(source.read_text(encoding="utf-8") + "% later\n", encoding="utf-8")
    with pytest.raises(StoreError, match="domain text"):
        check_unchanged(run, load_config("quickstart", [f"domain={source}"]))


def test_a_folder_without_a_run_is_said_to_be_none(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="is not a run folder"):
        read_config(tmp_path)


def test_of_a_long_difference_the_beginning_is_shown_what_was_given_first(
    tmp_path: Path, configure: Configure
) -> None:
    write_config(tmp_path, configure())
    own = tmp_path / "own.yaml"
    own.write_text('name: own\ngoal: ["loc(book1,office1)"]\nrepeats: 3\n', encoding="utf-8")
    with pytest.raises(StoreError) as refused:
        check_unchanged(tmp_path, load_config(own))
    _, *changes, rest = str(refused.value).splitlines()
    assert len(changes) == 8
    # `repeats` stands behind more than 8 keys that differ by default.
    assert {"name", "goal", "repeats"} <= {line.split(":")[0].strip() for line in changes}
    with pytest.raises(StoreError) as few:
        check_unchanged(tmp_path, configure("seed=77"))
    assert str(few.value).splitlines()[1:] == ["  seed: 1 -> 77"]
    assert rest.strip().removeprefix("and ").removesuffix(" more").isdigit()


def test_a_file_is_the_old_one_until_the_new_one_is_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "summary.json"
    replace_text(path, "old")

    def fail(*_: object) -> None:
        raise OSError("no space left on the disk")

    monkeypatch.setattr("testbed.experiment.run_folder.os.replace", fail)
    with pytest.raises(OSError, match="no space"):
        replace_text(path, "new")
    assert path.read_text(encoding="utf-8") == "old"


def test_of_a_domain_that_changed_the_first_line_that_differs_is_told(tmp_path: Path) -> None:
    source, run = tmp_path / "own.al", tmp_path / "run"
    text = asp.load_description("office").source
    source.write_text(text, encoding="utf-8")
    config = load_config("quickstart", [f"domain={source}"])
    write_config(run, config)
    first, *rest = text.split("\n")
    for changed, line in (("\n".join([first, "% else", *rest]), 2), (text + "% more\n", None)):
        source.write_text(changed, encoding="utf-8")
        with pytest.raises(StoreError) as refusal:
            check_unchanged(run, load_config("quickstart", [f"domain={source}"]))
        (told,) = str(refusal.value).splitlines()[1:]
        assert f"line {line or text.count(chr(10)) + 1}:" in told
        assert "% " in told
