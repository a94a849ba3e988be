"""The command line as a user meets it: processes, exit codes, what is printed where."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

import pytest

import asp
from benchmarks import killing

COMMAND = [sys.executable, "-m", "testbed"]
PAIR = ["run", "quickstart", "scenarios=[2]", "link=inprocess", "--quiet", "--out", "run"]
HELD = [sys.executable, "-m", "tests.held"]
KEPT = [
    "config.yaml",
    "provenance.json",
    "report.html",
    "stories.jsonl",
    "summary.json",
    "table.json",
    "trials.jsonl",
    "trials.parquet",
]


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands run in a folder of the test's own, and import from this checkout."""
    root = str(Path(__file__).parents[2])
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([root, os.environ.get("PYTHONPATH", "")]))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "150")


def _testbed(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*COMMAND, *arguments], check=False, capture_output=True, text=True)


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run of one pair; tests change copies of it."""
    folder = tmp_path_factory.mktemp("finished")
    done = subprocess.run([*COMMAND, *PAIR], check=False, capture_output=True, cwd=folder)
    assert done.returncode == 0, done.stderr
    return folder / "run"


@pytest.fixture
def run(finished: Path, tmp_path: Path) -> Path:
    """A copy of it in the folder in which commands run."""
    return shutil.copytree(finished, tmp_path / "run")


def _refused(*arguments: str) -> str:
    done = _testbed(*arguments)
    assert done.returncode == 2, done.stderr
    assert "Traceback" not in done.stderr
    return done.stderr.strip()


def _trials(folder: str | Path) -> list[dict[str, object]]:
    lines = (Path(folder) / "trials.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line) for line in lines]


OWN = ("crc32", "origin")
"""What a record says of its line and of where it was played."""


def _untimed(folder: str | Path) -> list[dict[str, object]]:
    return [
        {k: v for k, v in t.items() if not k.endswith(("_time_s", "_cpu_s")) and k not in OWN}
        for t in _trials(folder)
    ]


def test_a_run_leaves_everything_in_its_folder_and_a_table_on_the_screen() -> None:
    done = _testbed("run", "quickstart", "scenarios=[2]", "link=inprocess")
    assert done.returncode == 0, done.stderr
    kept = {path.name for path in Path("runs/quickstart").iterdir()}
    assert kept - {"difference.patch", ".lock"} == set(KEPT)
    header, intentional, traditional = done.stdout.splitlines()[:3]
    for word in ("scenario", "robot", "achieved", "plans", "actions", "units", "planning", "expl"):
        assert word in header
    assert "intentional" in intentional
    assert "exo_move(book2,library)" in intentional
    assert "traditional" in traditional
    assert "runs/quickstart/report.html" in done.stdout
    provenance = json.loads(Path("runs/quickstart/provenance.json").read_text(encoding="utf-8"))
    assert provenance["command"] == [
        "testbed",
        "run",
        "quickstart",
        "scenarios=[2]",
        "link=inprocess",
    ]
    assert provenance["start"] <= provenance["end"]
    assert provenance["exit"] == 0
    assert provenance["workers"] == 1
    assert provenance["versions"]["clingo"]
    summary = json.loads(Path("runs/quickstart/summary.json").read_text(encoding="utf-8"))
    assert summary["scenarios"]["2"]["accuracy"] == {"intentional": 1.0, "traditional": 1.0}


def test_a_quiet_run_over_zenoh_says_nothing() -> None:
    done = _testbed("run", "quickstart", "scenarios=[1]", "--quiet", "--out", "here")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert [trial["outcome"] for trial in _trials("here")] == ["achieved", "achieved"]


def test_a_run_can_be_run_again_from_its_folder() -> None:
    _testbed("run", "quickstart", "scenarios=[5]", "link=inprocess", "--out", "first")
    done = _testbed("run", "first/config.yaml", "--out", "second")
    assert done.returncode == 0, done.stderr
    assert _untimed("first") == _untimed("second")


@pytest.mark.load
@pytest.mark.parametrize("workers", ["1", "2"])
def test_an_interrupted_run_keeps_what_is_finished_and_goes_on(workers: str) -> None:
    arguments = [
        "run",
        "quickstart",
        "scenarios=[2,4,5,6]",
        "robots=[tests.held:Held]",
        "link=inprocess",
    ]
    arguments += ["--workers", workers, "--out"]
    process = _held(1, *arguments, "part")
    records = Path("part/trials.jsonl")
    while process.poll() is None and not (records.exists() and b"\n" in records.read_bytes()):
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does it: to all of the group
    output, errors = process.communicate()
    assert process.returncode == 130
    assert "Traceback" not in errors
    assert "--resume" in output
    kept = records.read_bytes()
    assert 1 <= len(_trials("part")) <= int(workers)
    assert kept.endswith(b"\n")
    Path("hold").unlink()
    for further in (["part", "--resume"], ["whole"]):
        done = subprocess.run([*HELD, *arguments, *further], check=False, capture_output=True)
        assert done.returncode == 0, done.stderr
    assert records.read_bytes().startswith(kept)
    assert len(_trials("whole")) == 4
    assert sorted(map(str, _untimed("part"))) == sorted(map(str, _untimed("whole")))


def _held(trials: int, *arguments: str) -> subprocess.Popen[str]:
    """The command line, in a group of its own, whose robot is stuck after so many trials."""
    Path("hold").write_text(str(trials))
    return subprocess.Popen(
        [*HELD, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


@pytest.mark.load
def test_a_killed_driver_takes_its_processes_along_and_the_run_goes_on() -> None:
    arguments = ["run", "office", "scenarios=[1]", "limit=6", "--out", "run", "--workers", "2"]
    process = subprocess.Popen(
        [*killing.COMMAND, "1", *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert process.stdout is not None
    assert killing.HELD in map(str.strip, process.stdout)
    process.kill()
    # Workers and robots hold the pipe open as long as they live: this returns when all are gone.
    process.communicate()
    assert len(_trials("run")) == 1
    assert _testbed(*arguments, "--resume", "--quiet").returncode == 0
    assert len(_trials("run")) == len({str(trial["trial"]) for trial in _trials("run")}) == 12


@pytest.mark.load
def test_resuming_another_configuration_is_refused_with_the_difference(run: Path) -> None:
    assert "--resume" in _refused(*PAIR)
    assert "seed: 1 -> 9" in _refused(*PAIR, "seed=9", "--resume")
    assert len(_trials(run)) == 2


def test_a_trial_in_error_gives_exit_code_1_and_keeps_the_rest() -> None:
    held = "[{step: 2, action: 'exo_move(book1,office1)'}]"
    script = f"scenario_settings.1.script={held}"
    done = _testbed(
        "run", "quickstart", "scenarios=[1,2]", "link=inprocess", script, "--out", "run"
    )
    assert done.returncode == 1
    assert [trial["outcome"] for trial in _trials("run")] == [
        "error",
        "error",
        "achieved",
        "achieved",
    ]
    assert "exo_move(book1,office1)" in str(_trials("run")[0]["reason"])
    assert "2 trials ended in error or without a robot" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["run", "quikstart"], "quikstart: no such file; did you mean 'quickstart'?"),
        (["check", "quickstart", "limts=2"], "command line: limts: unknown key"),
        (["check", "quickstart", "goal=[loc(book1,libary)]"], "did you mean 'library'?"),
        (["check", "quickstart", "robots=[intentinal]"], "did you mean 'intentional'?"),
        (
            ["check", "quickstart", "script=[{step: 1, action: exo_lock(library)}]"],
            "script[0].step: at step 1 the robot 'intentional' does not act on the world yet",
        ),
        (["report", "nowhere"], "nowhere: is not a run folder"),
        (["export", "nowhere"], "nowhere: is not a run folder"),
        (["replay", "nowhere", "--trial", "a"], "nowhere: is not a run folder"),
        (["translate", "nowhere.al"], "nowhere.al: no such"),
        (["robot", "--config", "nowhere.json5"], "nowhere.json5"),
        (["robot", "--connect", "nonsense"], "nonsense"),
        (["run"], "CONFIG"),
        (["run", "quickstart", "--workers", "0"], "--workers"),
        (["fly"], "fly"),
    ],
)
def test_bad_input_costs_one_line_and_exit_code_2(arguments: list[str], said: str) -> None:
    assert said in _refused(*arguments)


def test_a_configuration_error_says_file_line_and_key() -> None:
    Path("mine.yaml").write_text('name: mine\ngoal: ["loc(book1,attic)"]\n', encoding="utf-8")
    assert _refused("check", "mine.yaml") == (
        "mine.yaml:2: goal[0]: 'attic' in loc(book1,attic) is not known there; "
        "known: kitchen, library, office1, office2"
    )


def test_check_prints_a_configuration_that_checks_again() -> None:
    first = _testbed("check", "office", "limit=3", "limits.steps=40")
    assert first.returncode == 0
    Path("resolved.yaml").write_text(first.stdout, encoding="utf-8")
    assert _testbed("check", "resolved.yaml").stdout == first.stdout
    assert "limit: 3\n" in first.stdout
    assert "  steps: 40\n" in first.stdout


def test_translate_prints_or_writes_the_program() -> None:
    printed = _testbed("translate", "office")
    assert printed.returncode == 0
    assert "holds(loc(R,L),I+1)" in printed.stdout
    Path("own.al").write_text(asp.load_description("office").source, encoding="utf-8")
    assert _testbed("translate", "own.al", "-o", "own.lp").returncode == 0
    assert Path("own.lp").read_text(encoding="utf-8") == printed.stdout


def test_a_mistake_in_a_description_is_placed() -> None:
    Path("bad.al").write_text("sorts\n  room = {kitchen}.\nfluents\n  inertial at(rom).\n")
    assert _refused("translate", "bad.al").startswith("bad.al:4:")


def test_report_makes_everything_again_from_the_trials(run: Path) -> None:
    before = {name: (run / name).read_bytes() for name in KEPT}
    (run / "report.html").unlink()
    (run / "summary.json").unlink()
    done = _testbed("report", "run")
    assert done.returncode == 0
    assert "intentional" in done.stdout
    assert {name: (run / name).read_bytes() for name in KEPT} == before


def test_replay_tells_the_trial_and_whether_it_is_as_recorded(run: Path) -> None:
    trial = next(str(t["trial"]) for t in _trials(run) if t["robot"] == "intentional")
    done = _testbed("replay", "run", "--trial", trial[:6])
    assert done.returncode == 0, done.stderr
    for word in (
        "world",
        "belief",
        "intention",
        "start(1)",
        "others       exo_move(book2,library)",
    ):
        assert word in done.stdout
    assert "explanation  exo_move(book2,library) at step" in done.stdout
    assert "unexpected   loc(book2,library) at step" in done.stdout
    assert "because      no activity for the goal; " in done.stdout
    assert done.stdout.splitlines()[-1] == "as recorded"
    assert "not one of the run's 2 trials" in _refused("replay", "run", "--trial", "zzz")


def test_replay_without_a_trial_lists_them(run: Path) -> None:
    done = _testbed("replay", "run")
    assert done.returncode == 0, done.stderr
    assert [line.split()[0] for line in done.stdout.splitlines()[1:3]] == [
        trial["trial"] for trial in _trials(run)
    ]


def test_replay_says_where_it_differs_from_the_record(run: Path) -> None:
    path = run / "trials.jsonl"
    records = [{**trial, "action_count": 7} for trial in _trials(run)]
    for record in records:
        del record["version"], record["crc32"]  # as lines were before they had a checksum
    path.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
    done = _testbed("replay", "run", "--trial", str(_trials(run)[0]["trial"]))
    assert done.returncode == 1
    assert "differs from the record: action_count was 7, is 9" in done.stdout


def test_help_shows_an_example_a_line() -> None:
    lines = [line.strip() for line in _testbed("run", "--help").stdout.splitlines()]
    examples = lines[lines.index("Examples:") + 1 :]
    assert examples[0] == "testbed run quickstart"
    assert len(examples) == 4
    assert all(line.startswith("testbed run ") for line in examples)
    overview = _testbed("--help").stdout
    for command in ("run", "check", "robot", "report", "export", "replay", "translate"):
        assert command in overview


def test_the_version_is_that_of_the_distribution() -> None:
    done = _testbed("--version")
    assert (done.returncode, done.stdout) == (0, f"testbed {version('intention-testbed')}\n")


@pytest.mark.load
def test_an_interrupt_while_workers_start_leaves_no_traceback() -> None:
    arguments = [
        "run",
        "quickstart",
        "robots=[tests.held:Held]",
        "link=inprocess",
        "--workers",
        "2",
    ]
    process = _held(0, *arguments, "--out", "run")
    while process.poll() is None and not Path("run/trials.jsonl").exists():
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate()
    assert process.returncode == 130
    assert "Traceback" not in errors
