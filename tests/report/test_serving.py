"""Reports are served to browsers of this machine: all trials, and nothing else."""

import json
import shlex
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator, Sequence
from http.client import HTTPConnection, HTTPResponse
from pathlib import Path
from threading import Thread
from typing import Any
from urllib.parse import urlencode

import pytest

from testbed.analysis import load_run
from testbed.config import load_config
from testbed.experiment import store
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import Attempt, Occurrence, TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import write_config
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.report.serving import HEADERS, Server, Site
from tests.experiment.samples import a_record

PAGE = "<!doctype html><title>own</title>"
PAIRS = 30
IN_KITCHEN = ["loc(book1,kitchen)", "loc(book2,kitchen)", "loc(rob1,kitchen)"]


def records(run: str = "") -> Iterator[TrialRecord]:
    """Pairs of two robots under two conditions; the second robot fails in every tenth pair.

    Trials of another run have other ids, and are of the same pairs.
    """
    for cell in ("calm", "wild"):
        for number in range(PAIRS):
            for robot in ("one", "two"):
                failed = robot == "two" and number % 10 == 0
                yield a_record(
                    f"{run}{cell}-{number:02}-{robot}",
                    pair=f"{number:02}{cell}",
                    cell=cell,
                    scenario="1" if number % 2 else "3",
                    robot=robot,
                    initial=IN_KITCHEN,
                    steps=2,
                    actions=[Attempt(1, "move(rob1,office2)", True)],
                    exogenous=[Occurrence(1, "exo_lock(library)", False)],
                    achieved=not failed,
                    correct=not failed,
                    outcome="gave_up" if failed else "achieved",
                )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("runs") / "own"
    write_config(made, load_config("office", ["name=own"]))
    (made / store.TRIALS).write_bytes(b"".join(map(store.encode, records())))
    (made / "secret.txt").write_text("secret")
    return made


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[Server]:
    yield from _serving(Site(PAGE, [load_run(folder)]))


@pytest.fixture(scope="module")
def folders(folder: Path) -> list[Path]:
    """Three runs: the second is for something else, the third for the same as the first."""
    made = [folder, folder.parent / "the other", folder.parent / "twin"]
    for number, (own, name) in enumerate(zip(made, ("own", "other", "own"), strict=True)):
        if number:
            write_config(own, load_config("office", [f"name={name}"]))
            lines = map(store.encode, records(f"r{number}-"))
            (own / store.TRIALS).write_bytes(b"".join(lines))
    return made


@pytest.fixture(scope="module")
def three(folders: list[Path]) -> Iterator[Server]:
    runs = [load_run(folder) for folder in folders]
    yield from _serving(Site(PAGE, runs), [Site(f"{PAGE} {run.folder}", [run]) for run in runs])


def _serving(whole: Site, parts: Sequence[Site] = ()) -> Iterator[Server]:
    with Server(whole, parts) as made:
        thread = Thread(target=made.serve_forever)
        thread.start()
        yield made
        made.shutdown()
        thread.join()


def ask(
    server: Server, path: str, method: str = "GET", host: str | None = None
) -> tuple[HTTPResponse, bytes]:
    name, port = server.server_address[:2]
    connection = HTTPConnection(str(name), int(port), timeout=300)
    headers = {} if host is None else {"Host": host}
    connection.request(method, path, headers=headers)
    response = connection.getresponse()
    text = response.read()
    connection.close()
    return response, text


def told(server: Server, path: str, **query: object) -> dict[str, Any]:
    response, text = ask(server, f"{path}?{urlencode(query)}" if query else path)
    assert response.status == 200, text
    assert response.getheader("Content-Type") == "application/json"
    found: dict[str, Any] = json.loads(text)
    return found


def refused(server: Server, path: str, status: int, **given: str) -> str:
    response, text = ask(server, path, **given)
    assert response.status == status
    assert response.getheader("Content-Type") == "application/json"
    error = json.loads(text) if text else {"code": status, "message": ""}
    assert error["code"] == status
    assert "Traceback" not in error["message"]
    assert "\n" not in error["message"]
    return str(error["message"])


def test_it_listens_to_this_machine_alone(server: Server) -> None:
    assert server.server_address[0] == "127.0.0.1"
    assert server.address == f"http://127.0.0.1:{server.server_address[1]}/"


def test_the_page_is_served_with_what_it_may_do(server: Server) -> None:
    response, text = ask(server, "/")
    assert (response.status, text.decode()) == (200, PAGE)
    for name, value in HEADERS.items():
        assert response.getheader(name) == value


def test_all_trials_are_found_page_by_page(server: Server) -> None:
    seen: list[str] = []
    for offset in range(0, 2 * PAIRS, 7):
        page = told(server, "/trials.json", offset=offset, limit=7)
        assert (page["total"], page["pairs"]) == (4 * PAIRS, 2 * PAIRS)
        pairs = [trial["pair"] for trial in page["trials"]]
        assert pairs[::2] == pairs[1::2]
        seen += [trial["id"] for trial in page["trials"]]
    assert sorted(seen) == sorted(record.trial for record in records())


def test_pairs_with_failures_come_first(server: Server) -> None:
    page = told(server, "/trials.json", limit=7)
    failed = [
        any(t["outcome"] == "gave_up" for t in page["trials"][n : n + 2]) for n in range(0, 14, 2)
    ]
    assert failed == [True] * 6 + [False]


def test_trials_are_chosen_by_what_they_have(server: Server) -> None:
    page = told(server, "/trials.json", condition="wild", robot="two", outcome="gave_up", level="")
    assert {trial["id"] for trial in page["trials"]} == {f"wild-{n:02}-two" for n in (0, 10, 20)}
    assert (page["total"], page["pairs"]) == (3, 3)
    assert page["facets"]["robot"] == {"two": 3}
    assert page["facets"]["outcome"] == {"achieved": PAIRS - 3, "gave_up": 3}
    assert page["facets"]["condition"] == {"calm": 3, "wild": 3}
    assert set(page["facets"]) == {"study", "condition", "scenario", "level", "robot", "outcome"}
    assert told(server, "/trials.json", robot="nobody")["trials"] == []


def test_a_listed_trial_has_its_record_step_by_step(server: Server) -> None:
    (trial,) = told(server, "/trials.json", limit=1, robot="one", condition="calm")["trials"]
    kinds = [(step["kind"], step.get("action"), step.get("event")) for step in trial["story"]]
    event = "exo_lock(library)"
    assert kinds == [
        ("done", "move(rob1,office2)", event),
        ("mental", "wait", None),
        ("end", None, None),
    ]
    assert all("scene" not in step for step in trial["story"])


def test_a_trial_comes_with_its_pair_and_drawings(server: Server) -> None:
    found = told(server, "/trial/wild-07-two.json")
    assert [trial["id"] for trial in found["trials"]] == ["wild-07-one", "wild-07-two"]
    numbers = {step["scene"] for trial in found["trials"] for step in trial["story"]}
    assert numbers == set(range(len(found["scenes"]))) == {0, 1}
    assert all("<svg" in drawing for drawing in found["scenes"])


@pytest.mark.parametrize(
    "query",
    ["limit=0", "limit=201", "limit=x", "limit=-1", "limit=%D9%A1", "offset=-1", "offset=1e3",
     f"offset={'9' * 5000}", "offset=", "robot=one&robot=two", "colour=red",
     "&".join(f"k{n}=1" for n in range(40))],
)  # fmt: skip
def test_a_query_out_of_bounds_is_refused(server: Server, query: str) -> None:
    assert refused(server, f"/trials.json?{query}", 400)


@pytest.mark.parametrize(
    "path",
    ["/secret.txt", "/../secret.txt", "/..%2fsecret.txt", "/trials.jsonl", "/config.yaml",
     "/trial/../secret.txt", "/trial/%2e%2e.json", "/trial/nobody.json", "/trial/.json", "/1/",
     "/trial/wild-07-two.json/", "//etc/passwd", "/etc/passwd", "/favicon.ico"],
)  # fmt: skip
def test_nothing_else_is_to_be_had(server: Server, path: str) -> None:
    refused(server, path, 404)


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "HEAD", "OPTIONS", "PATCH", "OWN"])
def test_only_get_is_answered(server: Server, method: str) -> None:
    refused(server, "/", 405, method=method)


@pytest.mark.parametrize(
    "host", ["example.org", "127.0.0.1", "127.0.0.1:1", "localhost", "", "0.0.0.0"]
)
def test_another_name_for_this_machine_is_refused(server: Server, host: str) -> None:
    for path in ("/", "/trials.json", "/trial/wild-07-two.json"):
        refused(server, path, 403, host=host)


def test_this_machine_has_two_names(server: Server) -> None:
    response, _ = ask(server, "/", host=f"localhost:{server.server_address[1]}")
    assert response.status == 200


@pytest.mark.parametrize(
    "sent",
    [
        b"GET / HTTP/1.1\r\n\r\n",
        b"\x00\xff\r\n\r\n",
        b"GET /" + b"x" * 70000 + b" HTTP/1.1\r\n\r\n",
    ],
)
def test_what_is_no_question_of_a_browser_gets_an_error(server: Server, sent: bytes) -> None:
    with socket.create_connection(server.server_address[:2], timeout=300) as connection:
        connection.sendall(sent)
        answer = b""
        while part := connection.recv(65536):
            answer += part
    assert json.loads(answer.rpartition(b"\r\n\r\n")[2])["code"] in (400, 403, 414)


def test_of_several_runs_each_has_an_address_of_its_own(three: Server) -> None:
    assert b"the other" in ask(three, "/2/")[1]
    assert told(three, "/1/trials.json", limit=1)["pairs"] == 2 * PAIRS
    found = told(three, "/2/trials.json", limit=1)
    assert found["facets"]["study"] == {"other": 4 * PAIRS}
    assert told(three, "/2/trial/r1-wild-07-two.json")["trials"]
    refused(three, "/2/trial/wild-07-two.json", 404)
    for path in ("/4/", "/1", "/1/trials", "/0/", "/1/1/"):
        refused(three, path, 404)


def test_several_runs_have_all_trials_together(three: Server, folders: list[Path]) -> None:
    one, other, twin = folders
    page = told(three, "/trials.json", limit=3 * 6 + 1)
    assert (page["total"], page["pairs"]) == (12 * PAIRS, 6 * PAIRS)
    studies = {f"own ({one})": one, "other": other, f"own ({twin})": twin}
    assert page["facets"]["study"] == dict.fromkeys(studies, 4 * PAIRS)
    pairs = [page["trials"][n : n + 2] for n in range(0, len(page["trials"]), 2)]
    assert all(a["study"] == b["study"] and a["pair"] == b["pair"] for a, b in pairs)
    failed = [any(own["outcome"] == "gave_up" for own in pair) for pair in pairs]
    assert failed == [True] * 18 + [False]
    for study, folder in studies.items():
        found = told(three, "/trials.json", study=study, limit=200)
        assert found["total"] == 4 * PAIRS
        assert {own for trial in found["trials"] for own in trial["study"]} == {study}
        commands = [shlex.split(trial["command"]) for trial in found["trials"]]
        assert all(command[2] == str(folder) for command in commands)


def test_a_trial_of_several_runs_comes_with_its_pair_in_its_own_run(
    three: Server, folders: list[Path]
) -> None:
    for start, folder in zip(("", "r1-", "r2-"), folders, strict=True):
        found = told(three, f"/trial/{start}wild-07-two.json")
        ids = [trial["id"] for trial in found["trials"]]
        assert ids == [f"{start}wild-07-one", f"{start}wild-07-two"]
        assert {shlex.split(trial["command"])[2] for trial in found["trials"]} == {str(folder)}


def test_runs_of_one_configuration_are_told_apart(folder: Path, tmp_path: Path) -> None:
    """Their trials have the same ids; one that is asked for by its id alone is the first run's."""
    copied = tmp_path / "copied"
    shutil.copytree(folder, copied)
    for server in _serving(Site(PAGE, [load_run(folder), load_run(copied)])):
        assert told(server, "/trials.json")["total"] == 8 * PAIRS
        for own in (folder, copied):
            study = f"own ({own})"
            found = told(server, "/trials.json", study=study, limit=200)
            assert found["total"] == len(found["trials"]) == 4 * PAIRS
            trials = [
                *found["trials"],
                *told(server, "/trial/calm-07-one.json", study=study)["trials"],
            ]
            assert {shlex.split(trial["command"])[2] for trial in trials} == {str(own)}
        first = told(server, "/trial/calm-07-one.json")["trials"]
        assert {shlex.split(trial["command"])[2] for trial in first} == {str(folder)}
        assert [trial["id"] for trial in first] == ["calm-07-one", "calm-07-two"]
        refused(server, "/trial/calm-07-one.json?study=nothing", 404)
        refused(server, "/trial/calm-07-one.json?colour=red", 400)


def test_a_run_that_is_given_twice_is_one(folder: Path) -> None:
    for server in _serving(Site(PAGE, [load_run(folder), load_run(folder)])):
        assert told(server, "/trials.json")["total"] == 4 * PAIRS


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of one pair, whose trials are those that its configuration plans."""
    return _played(tmp_path_factory.mktemp("runs") / "played", "scenarios=[1]")


def _played(made: Path, setting: str) -> Path:
    given = [f"name={made.name}", "limit=1", "link=inprocess", setting]
    config = load_config("office", given)
    write_config(made, config)
    results = (play_trial(spec, InProcessRobot(make_robot)) for spec in plan_trials(config))
    (made / store.TRIALS).write_bytes(b"".join(store.encode(own.record) for own in results))
    return made


def report(*arguments: str | Path) -> list[str]:
    return [sys.executable, "-m", "testbed", "report", *map(str, arguments)]


def _answers(folders: Sequence[Path], *paths: str) -> list[str]:
    """What the command answers to these questions, until it is interrupted."""
    command = report("--serve", *folders)
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        said = next(line for line in process.stdout if line.startswith("serving "))
        address = said.split()[1].removeprefix("http://").strip("/")
        connection = HTTPConnection(address, timeout=300)
        found = []
        for path in paths:
            connection.request("GET", path)
            found.append(connection.getresponse().read().decode())
        connection.close()
        process.send_signal(signal.SIGINT)
        assert process.wait() == 0
    return found


def _data(page: str) -> dict[str, Any]:
    """What the explorer of a page is told."""
    data = page.partition('id="explorer-data">')[2].partition("</script>")[0]
    found: dict[str, Any] = json.loads(data)
    return found


def test_the_command_serves_until_it_is_interrupted(played: Path) -> None:
    page, found = _answers([played], "/", "/trials.json?limit=1")
    assert json.loads(found)["pairs"] == 1
    assert (played / "report.html").is_file()
    assert _data(page)["served"] is True


def test_the_command_serves_several_runs_in_one_page(played: Path, tmp_path: Path) -> None:
    other = _played(tmp_path / "more runs" / "another", "scenarios=[2]")
    page, found, single, alone = _answers(
        [played, other], "/", "/trials.json", "/2/", "/2/trials.json"
    )
    assert (_data(page)["served"], _data(page)["total"]) == (True, 4)
    assert shlex.split(_data(page)["command"])[3:] == [str(played), str(other)]
    assert 'href="1/"' in page
    assert 'href="2/"' in page
    assert json.loads(found)["facets"]["study"] == {"another": 2, "played": 2}
    assert json.loads(alone)["facets"]["study"] == {"another": 2}
    assert shlex.split(_data(single)["command"])[3:] == [str(other)]


def test_a_port_that_is_taken_is_one_line(played: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        command = report("--serve", "--port", port, played)
        ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 2
    (line,) = ended.stderr.splitlines()
    assert f"127.0.0.1:{port}" in line


def test_a_port_without_serving_is_refused(played: Path) -> None:
    command = report("--port", "8000", played)
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 2
    (line,) = ended.stderr.splitlines()
    assert "--port" in line
