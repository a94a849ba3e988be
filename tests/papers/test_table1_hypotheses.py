"""Hypotheses over pairs made by hand, and the page's frame."""

import re
from pathlib import Path

import pytest

from papers.table1.document import Sources, document
from papers.table1.evidence import closeness
from papers.table1.hypotheses import Hypothesis, compared, hypotheses
from papers.table1.pairs import Pair, Side
from papers.table1.parts import part_of
from papers.table1.runs import read_run, told_name, told_order
from testbed.config import load_config
from testbed.experiment import StoreError
from testbed.experiment.digest import digest
from testbed.experiment.record import Activity, Attempt, TrialRecord
from testbed.experiment.run_folder import write_config
from testbed.experiment.store import encode, read_records
from testbed.studies.table1.published import MEASURES, PUBLISHED, SCENARIOS
from testbed.world import load_world
from tests.experiment.samples import a_record
from tests.papers.prose import says
from tests.studies.table1.made import a_pair, a_side

NEAR_FIRST = Path(__file__).parents[2] / "examples" / "near-first.al"
GOAL = ["loc(book1,library)", "loc(book2,library)", "-in_hand(rob1,book1)"]
HELD, PLACED, BARE = "in_hand(rob1,book1)", "loc(book2,library)", "loc(book2,kitchen)"
LATE = ("move(rob1,kitchen)", "move(rob1,library)")


def _pair(trial: str, state: str, right: bool, before: tuple[str, ...] = LATE[:1]) -> Pair:
    base = a_side(right, actions=2 if right else 1)
    return a_pair("3", a_side(trial=trial, before=before), base, state=state)


PAIRS = [
    _pair("a", f"{HELD} {BARE}", right=True),
    _pair("b", f"{HELD} {PLACED}", right=False),
    _pair("c", BARE, right=True, before=LATE),
    _pair("d", f"{PLACED} {BARE}", right=False, before=LATE),
    a_pair("3", a_side(trial="e"), intended="3"),
]


@pytest.mark.parametrize(
    ("name", "accuracy"),
    [
        ("as played", 2 / 4),
        ("starts: something in hand", 1 / 2),
        ("starts: nothing in hand", 1 / 2),
        ("starts: nothing in place", 2 / 2),
        ("starts: something in place", 0 / 2),
        ("event beside the first action", 1 / 2),
        ("event beside a later action", 1 / 2),
    ],
)
def test_each_hypothesis_has_its_own_part_of_the_pairs(name: str, accuracy: float) -> None:
    found = {own.name: own.part for own in hypotheses(PAIRS, GOAL)}
    row = {row.name: row for row in found[name].table.rows}["3"]
    assert row.baseline is not None
    assert row.baseline.value == pytest.approx(accuracy)


def test_which_pairs_are_left_is_told_by_the_start() -> None:
    found = {own.name: own.part for own in hypotheses(PAIRS[:3], GOAL)}
    left = {name: own.table.rows[2].pairs for name, own in found.items()}
    assert left["as played"] == 3
    assert (left["starts: something in hand"], left["starts: nothing in hand"]) == (2, 1)
    assert (left["starts: something in place"], left["starts: nothing in place"]) == (1, 2)
    assert (left["event beside the first action"], left["event beside a later action"]) == (2, 1)


def _as_published(name: str, factor: float = 1.0, state: str = "s") -> Pair:
    """A pair whose ratios are the published ones, times a factor."""
    values = {m: factor * PUBLISHED[name].ratios[m] for m in MEASURES}
    return a_pair(name, baseline=a_side(PUBLISHED[name].baseline == 1.0, **values), state=state)


def _two(first: list[Pair], second: list[Pair]) -> str:
    ways = {"near": first, "far": second}
    return compared([Hypothesis(n, part_of(own)) for n, own in ways.items()], False, False)


def _best(page: str) -> str:
    """The hypothesis that the last paragraph names."""
    return re.findall(r"`(\w+)`", page)[-1]


def test_the_nearest_one_is_named_with_what_stays_outside_of_it() -> None:
    """In each row 20 pairs, of which TP gets all right or none."""
    exact = [_as_published(name, 1.0, f"s{n}") for name in SCENARIOS for n in range(20)]
    page = _two(exact, [_as_published(name, 2.0) for name in SCENARIOS])
    assert _best(page) == "near"
    outside = (3, "0.00", 0.72, 4, "0.00", 0.73)
    assert says(page, 18, 20, *outside, 800, 54, 2, 23, 5)


def test_of_as_many_inside_the_one_at_a_smaller_distance_is_nearer() -> None:
    near, far = [_as_published("5", 1.5)], [_as_published("5", 3.0)]
    assert (_best(_two(near, far)), _best(_two(far, near))) == ("near", "far")


def test_more_values_inside_are_nearer_than_a_smaller_distance() -> None:
    """Of 0.2 and 3 times the published values the mean is far off, the interval holds them."""
    wide = [_as_published("5", 0.2, "s1"), _as_published("5", 3.0, "s2")]
    tight = [_as_published("5", 1.1, "s1"), _as_published("5", 1.1, "s2")]
    ours, theirs = (closeness(part_of(own).table) for own in (wide, tight))
    assert ours.inside > theirs.inside
    assert ours.distance > theirs.distance
    assert (_best(_two(wide, tight)), _best(_two(tight, wide))) == ("near", "far")


def test_the_table_shows_what_is_asked_of_each_row() -> None:
    pairs = [
        a_pair("2", baseline=a_side(plans=3)),
        a_pair("3", baseline=a_side(False)),
        a_pair("3"),
        a_pair("5", a_side(actions=4, execution_units=10), a_side(False, execution_units=2)),
    ]
    page = compared([Hypothesis("made", part_of(pairs))], True, True)
    (line,) = (line for line in page.splitlines() if line.startswith("| made"))
    cells = line.strip("| ").split(" | ")
    assert cells[:7] == ["made", "50%", "-", "3.00", "0.20", "0.25", "0 25 50 0 25%"]


def _records(pairs: int) -> list[TrialRecord]:
    start = ["loc(rob1,kitchen)", "loc(book1,library)", "loc(book2,kitchen)"]
    plan = ["pickup(rob1,book2)", "move(rob1,library)", "put_down(rob1,book2)"]
    return [
        a_record(
            f"{robot}{number}",
            pair=str(number),
            robot=robot,
            scenario="random",
            initial=start,
            minimal_actions=3,
            minimal_units=25,
            steps=5,
            actions=[Attempt(2 + n, action, True) for n, action in enumerate(plan)],
            activities=[Activity(1, 1, plan)] if robot == "intentional" else [],
            plans=1,
            action_count=3,
            execution_units=25,
        )
        for number in range(pairs)
        for robot in ("intentional", "traditional")
    ]


def _folder(folder: Path, pairs: int, *overrides: str) -> Path:
    write_config(folder, load_config("table1", ["scenarios=[random]", *overrides]))
    (folder / "trials.jsonl").write_bytes(b"".join(map(encode, _records(pairs))))
    return folder


def test_the_page_lists_commands_and_digests_of_all_its_runs(tmp_path: Path) -> None:
    main = _folder(tmp_path / "main", 3)
    other = _folder(tmp_path / "other", 2, "name=told-library-kitchen-office2-office1")
    later = _folder(tmp_path / "later", 1, "name=later", "adversary.rate=0.3")
    near = _folder(tmp_path / "near", 1, "name=near-first", f"domain={NEAR_FIRST}")
    runs = [read_run(folder) for folder in (main, later, other, near)]
    page = document(Sources(runs[0], later=runs[1], told=(runs[2],), variants=(runs[3],)))
    for folder, name in (
        (main, "table1"),
        (other, "told-library-kitchen-office2-office1"),
        (later, "later"),
    ):
        assert f"| `runs/{name}` | `{digest(read_records(folder))}` |" in page
    assert (
        "$ python -m benchmarks.told runs/table1 runs/told-library-kitchen-office2-office1"
        " --order library kitchen office2 office1\n" in page
    )
    assert "--later runs/later --variant runs/near-first --told runs/told-library-kit" in page
    near_run = "name=near-first domain=examples/near-first.al 'scenarios=[random]' --workers"
    assert f"$ testbed run table1 {near_run}" in page
    assert "| near-first | " in page
    assert "testbed run table1 name=told" not in page
    assert "| rate 0.3 | " in page
    assert "| told, library, kitchen, office2, office1 | " in page


def test_the_variant_of_the_domain_differs_in_the_order_of_two_lines() -> None:
    packaged = load_world("office").description.source.splitlines()
    lines = NEAR_FIRST.read_text(encoding="utf-8").splitlines()
    comment = len(lines) - len(packaged)
    assert all(line.startswith("%") for line in lines[:comment])
    move = next(n for n, line in enumerate(packaged) if "agent     move(" in line)
    packaged[move], packaged[move + 1] = packaged[move + 1], packaged[move]
    assert lines[comment:] == packaged


def test_a_told_run_of_other_pairs_is_refused(tmp_path: Path) -> None:
    main, other = _folder(tmp_path / "main", 2), _folder(tmp_path / "other", 3, "name=told")
    assert told_order(read_run(other)) == []
    with pytest.raises(StoreError, match="its pairs are not those of"):
        document(Sources(read_run(main), told=(read_run(other),)))


@pytest.mark.parametrize("name", ["near-first", "told-kitchen", "told-", "retold"])
def test_a_run_of_another_name_was_told_nothing(tmp_path: Path, name: str) -> None:
    other = read_run(_folder(tmp_path / "other", 1, f"name={name}"))
    with pytest.raises(StoreError, match=f"name: {name} is not that of a run of benchmarks/told"):
        told_order(other)


def test_the_name_of_a_told_run_says_its_order(tmp_path: Path) -> None:
    for order in ([], ["library", "office1", "kitchen", "office2"]):
        folder = _folder(tmp_path / f"{len(order)}", 1, f"name={told_name(order)}")
        assert told_order(read_run(folder)) == order


def test_sides_made_by_hand_are_whole() -> None:
    assert isinstance(a_side(), Side)
    assert set(a_side().measures) >= set(MEASURES)
