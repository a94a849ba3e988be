"""The data of the explorer: trials with what there is to see step by step, and which of them."""

import json
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from zlib import crc32

import pytest

from asp.language import Action
from benchmarks.own import Own
from testbed.analysis import load_run
from testbed.analysis.table import table_of
from testbed.config import load_config
from testbed.experiment import store
from testbed.experiment.narration import narrator_in
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import At, Explained, Rejected, TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import write_config
from testbed.experiment.stories import Story, decode
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.report import explorer
from testbed.report.sample import MOST_FAILED, MOST_TRIALS, sampled
from tests.experiment.gardens import GARDEN, ROWS
from tests.experiment.samples import a_record
from tests.greenhouse import WINDY

RAKED = GARDEN.replace("OTHER", "rake")
LARGER = RAKED.replace("{north, south}", "{north, middle, south}").replace(
    "beside(north, south).", "beside(north, middle).\n  beside(middle, south)."
)
Played = tuple[Path, list[TrialRecord], dict[str, Story]]
Play = Callable[..., Played]


@pytest.fixture(scope="module")
def play(tmp_path_factory: pytest.TempPathFactory) -> Play:
    """Plays all trials of a configuration into a run folder."""

    def played(config: Path) -> Played:
        folder = tmp_path_factory.mktemp("run")
        own = load_config(config)
        write_config(folder, own)
        results = [
            play_trial(s, InProcessRobot(make_robot), lambda _: None) for s in plan_trials(own)
        ]
        records = [result.record for result in results]
        lines = [result.story or b"" for result in results]
        (folder / "trials.jsonl").write_bytes(b"".join(map(store.encode, records)))
        (folder / "stories.jsonl").write_bytes(b"".join(lines))
        return folder, records, {story.trial: story for story in map(decode, lines)}

    return played


@pytest.fixture(scope="module")
def garden(play: Play, tmp_path_factory: pytest.TempPathFactory) -> Played:
    own = Own(tmp_path_factory.mktemp("garden"), LARGER)
    goal = ["stands(spade,south)", "stands(rake,north)"]
    windy = {"strategy": "random", "rate": 0.5}
    never = {"stray": {"mode": "never"}}
    return play(own.write(goal=goal, limit=12, adversary=windy, observability=never))


def data_of(folder: Path) -> dict[str, Any]:
    text = str(explorer.explorer_of(load_run(folder)).data)
    assert "<" not in text
    told: dict[str, Any] = json.loads(text)
    return told


def test_a_served_page_asks_for_its_trials(garden: Played) -> None:
    folder, records, _ = garden
    told = json.loads(explorer.served_explorer([load_run(folder)]).data)
    assert (told["served"], told["total"], told["kept"]) == (True, len(records), 0)
    assert told["trials"] == told["scenes"] == []


def test_each_step_has_what_its_story_has(garden: Played) -> None:
    folder, records, stories = garden
    told = data_of(folder)
    assert (told["total"], told["kept"], told["served"]) == (len(records), len(records), False)
    events = mistakes = 0
    for trial in told["trials"]:
        story = stories[trial["id"]]
        *steps, end = trial["story"]
        assert end["kind"] == "end"
        assert end["step"] == trial["steps"] + 1
        for shown, step in zip(steps, story.steps, strict=True):
            assert (shown["step"], shown["action"]) == (step.step, step.action)
            kind = "mental" if step.happened is None else "done" if step.happened else "failed"
            assert shown["kind"] == kind
            assert shown.get("event") == step.event
            assert shown["mistaken"] == step.mistaken
            assert ("belief" in shown) is bool(step.mistaken)
            events += "event" in shown
            mistakes += "belief" in shown
            if "belief" in shown:
                assert "stroke-dasharray" in told["scenes"][shown["belief"]]
            assert "stroke-dasharray" not in told["scenes"][shown["scene"]]
    assert min(events, mistakes) > 0


def test_of_each_state_there_is_one_drawing(garden: Played) -> None:
    folder, _, stories = garden
    told = data_of(folder)
    numbers: dict[frozenset[str], int] = {}
    for trial in told["trials"]:
        states = stories[trial["id"]].states()
        for step, true in zip(trial["story"], states, strict=True):
            assert numbers.setdefault(true, step["scene"]) == step["scene"]
    assert len(set(numbers.values())) == len(numbers)
    assert len(set(told["scenes"])) == len(told["scenes"])


def test_without_stories_the_world_follows_from_the_records(garden: Played) -> None:
    folder, *_ = garden
    told = data_of(folder)
    stories = (folder / "stories.jsonl").read_bytes()
    (folder / "stories.jsonl").unlink()
    alone = data_of(folder)
    (folder / "stories.jsonl").write_bytes(stories)
    for trial, other in zip(told["trials"], alone["trials"], strict=True):
        for step, bare in zip(trial["story"], other["story"], strict=True):
            keys = ("step", "kind", "action", "mental", "event", "seen")
            assert [step.get(key) for key in keys] == [bare.get(key) for key in keys]
            assert told["scenes"][step["scene"]] == alone["scenes"][bare["scene"]]
            assert bare.get("mistaken") is None


def test_the_last_whole_line_of_a_trial_is_its_story(garden: Played) -> None:
    folder, _, stories = garden
    file = folder / "stories.jsonl"
    lines = file.read_bytes()
    first, second, *_ = stories
    other = b'{"trial":"%s","steps":[{"step":9,"action":"own"}]}\n' % first.encode()
    torn = lines.splitlines()[-1][:-20]
    file.write_bytes(
        lines + b"\x00nothing\n" + other + b'{"trial":"%s",[\n' % second.encode() + torn
    )
    told = {trial["id"]: trial["story"] for trial in data_of(folder)["trials"]}
    file.write_bytes(lines)
    assert [step.get("action") for step in told[first]] == ["own", None]
    assert all(
        "intention" not in step.get("mind", {}) for step in told[second]
    )  # damaged: the record alone
    assert len(told) == len(stories)


def test_without_places_the_data_is_as_whole(play: Play, tmp_path: Path) -> None:
    folder, records, _ = play(Own(tmp_path, WINDY).write(goal=["stands(fern,sill)"], limit=4))
    told = data_of(folder)
    assert told["kept"] == len(records) > 0
    for trial in told["trials"]:
        assert all("fern" in told["scenes"][step["scene"]] for step in trial["story"])


def test_the_fine_resolution_says_how_actions_are_carried_out(play: Play, tmp_path: Path) -> None:
    own = Own(tmp_path, RAKED, ROWS)
    goal = ["stands(spade,south)"]
    folder, *_ = play(own.write(goal=goal, limit=2, robots=["intentional"]))
    told = data_of(folder)
    steps = [step for trial in told["trials"] for step in trial["story"]]
    terms = {term for step in steps for term in step.get("mind", {})}
    assert {"abstract", "refined to"} <= terms
    assert all(0 <= step["scene"] < len(told["scenes"]) for step in steps)
    assert len({step["scene"] for step in steps}) > 1


def test_a_bound_on_bytes_leaves_pairs_whole(
    garden: Played, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, records, _ = garden
    robots = len({record.robot for record in records})
    monkeypatch.setattr(explorer, "MOST_BYTES", 40_000)
    told = data_of(folder)
    assert 0 < told["kept"] < told["total"] == len(records)
    assert set(Counter(trial["pair"] for trial in told["trials"]).values()) == {robots}
    shown = [step for trial in told["trials"] for step in trial["story"]]
    used = {step[key] for step in shown for key in ("scene", "belief") if key in step}
    assert used == set(range(len(told["scenes"])))
    assert len(explorer.encoded(told)) < 2 * 40_000


def many(cells: Sequence[str], pairs: int, failing: int) -> list[TrialRecord]:
    """Pairs of two robots under each condition, the second of which fails in some of them."""
    return [
        a_record(
            f"{cell}-{number:05}-{robot}",
            pair=f"{crc32(f'{cell} {number}'.encode()):08x}",
            cell=cell,
            robot=robot,
            **(
                {"achieved": False, "correct": False} if robot == "two" and number < failing else {}
            ),
        )
        for cell in cells
        for number in range(pairs)
        for robot in ("one", "two")
    ]


def cells_of(ids: Sequence[Sequence[str]]) -> Counter[str]:
    return Counter(pair[0].partition("-")[0] for pair in ids)


def test_a_sample_has_all_failures_and_some_of_each_condition() -> None:
    records = many("abc", 500, 20)
    chosen = list(sampled(table_of(records)))
    assert list(sampled(table_of(records))) == chosen
    assert all(len(pair) == 2 for pair in chosen)
    assert sum(map(len, chosen)) == MOST_TRIALS
    failed = [own for own in chosen if int(own[0].split("-")[1]) < 20]
    assert chosen[: len(failed)] == failed
    assert set(cells_of(failed).values()) == {20}
    others = cells_of(chosen[len(failed) :]).values()
    assert max(others) - min(others) <= 1


def test_of_more_failures_than_a_page_holds_each_condition_has_some() -> None:
    chosen = list(sampled(table_of(many("abc", 300, 200))))
    failed = [own for own in chosen if int(own[0].split("-")[1]) < 200]
    assert sum(map(len, failed)) == MOST_FAILED
    assert set(cells_of(failed).values()) == {MOST_FAILED // 6}
    assert sum(map(len, chosen)) <= MOST_TRIALS
    assert set(cells_of(chosen[len(failed) :])) == set("abc")


def test_where_all_failed_the_page_is_full() -> None:
    chosen = list(sampled(table_of(many("a", 300, 300))))
    assert sum(map(len, chosen)) == MOST_TRIALS


def test_a_record_alone_tells_what_was_not_possible_and_what_is_unproved(tmp_path: Path) -> None:
    blown, raised = (
        At(1, Action.parse("blow(sail)")),
        Rejected(2, Action.parse("raise(sail)"), "no"),
    )
    known = Explained(2, [blown], [], minimal="unproved")
    with store.TrialWriter(tmp_path) as writer:
        writer.append(a_record(steps=2, rejected=[raised], explanations=[known]))
    write_config(tmp_path, load_config("office"))
    (trial,) = data_of(tmp_path)["trials"]
    assert trial["story"][1]["skipped"] == ["raise(sail)"]
    (text,) = trial["story"][1]["mind"]["explanation"]
    assert text.startswith("blow(sail) at step 1")
    assert "unproved" in text


def test_what_a_mind_is_told_to_be_is_told_alike_in_lines_and_in_the_page(garden: Played) -> None:
    folder, _, stories = garden
    minds = {trial["id"]: trial["story"] for trial in data_of(folder)["trials"]}
    for trial, story in stories.items():
        for step, told in zip(story.steps, minds[trial], strict=False):
            lines: list[str] = []
            narrator_in(None, lines.append).tell(step)
            for term in ("unexpected", "explanation", "because"):
                own = [line[15:] for line in lines if line[2:].startswith(f"{term} ")]
                assert own == told["mind"].get(term, []), (trial, step.step)
