"""The sections of the page from pairs made by hand: each number is worked out beside it."""

import dataclasses

import pytest

from papers.table1 import evidence
from papers.table1.drawing import drawing, unclassified
from papers.table1.failing import blindness, failures, meetings
from papers.table1.others import heeding, later, unaided
from papers.table1.pairs import Pair
from papers.table1.rows import row_by_row
from papers.table1.runs import Run
from testbed.config import load_config
from testbed.studies.table1.published import PUBLISHED
from testbed.world import load_world
from tests.literals import parsed
from tests.papers.prose import numbers, says
from tests.studies.table1.made import a_pair, a_side, analysed

WORLD = load_world("office")
CONFIG = load_config("table1", ["name=made"])


def _lines(page: str) -> dict[str, list[str]]:
    """The lines of its tables by their first cell; what comes twice stands there once."""
    rows = [line.strip("| ").split(" | ") for line in page.splitlines() if line.startswith("| ")]
    return {row[0].strip(): [cell.strip() for cell in row[1:]] for row in rows}


UNDONE, LEFT = a_side(correct=False, undone=True), a_side(undone=False)
FAILING = [
    a_pair("3", baseline=UNDONE),
    a_pair("3", baseline=UNDONE),
    a_pair("3", baseline=LEFT),
    a_pair("4", baseline=LEFT),
    a_pair("5", intended="5", baseline=UNDONE),
    a_pair("1", treatment=a_side(event=None), intended="5", baseline=a_side(event=None)),
    a_pair("nothing to do"),
]


def test_pairs_are_told_apart_by_whether_the_event_undid_a_part_of_the_goal() -> None:
    seen = evidence.blindness([*FAILING[:3], a_pair("3", baseline=a_side(undone=True))])
    assert seen == evidence.Blindness(undone=3, undone_right=1, others=1, others_right=1)


def test_lost_trials_say_nothing_of_what_the_event_undid() -> None:
    lost = a_pair("3", baseline=a_side(correct=False, undone=True), apart="lost")
    assert evidence.blindness([lost]).undone == 0


def test_where_the_traditional_robot_fails_is_said_row_by_row() -> None:
    rows = _lines(blindness(FAILING))
    assert rows["random, 3"] == ["2", "0 of 2", "1", "1 of 1"]
    assert rows["random, 4"] == ["0", "0 of 0", "1", "1 of 1"]
    assert rows["triggered, 5"] == ["1", "0 of 1", "0", "0 of 0"]
    assert not {"random, nothing to do", "triggered, 1"} & set(rows)


def test_what_decides_its_accuracy_is_said_only_where_it_does() -> None:
    published = ("28%", 3, "27%", 4)
    assert says(blindness(FAILING), *published)
    otherwise = [
        *FAILING,
        a_pair("3", baseline=a_side(undone=True)),
        a_pair("4", baseline=a_side(False)),
    ]
    assert not says(blindness(otherwise), *published)
    assert numbers(blindness(otherwise)) == ["2"]


def test_failures_of_the_intentional_robot_come_with_their_replay() -> None:
    wrong = a_pair("3", treatment=a_side(False, trial="abc", outcome="gave_up"))
    pairs = [wrong, *FAILING]
    run = Run(None, CONFIG, {"intentional": pairs}, {})  # type: ignore[arg-type]  # no folder
    page = failures(run, "intentional")
    assert says(page, 1, 8)
    assert "$ testbed replay runs/made --trial abc " in page


def test_meetings_are_counted() -> None:
    other = a_pair("3", baseline=a_side(event="exo_lock(library)"))
    rows = _lines(meetings([*FAILING, other]))
    assert rows["nothing exogenous happened to either"] == ["1"]
    assert rows["same event beside the same action, after the same actions"] == ["6"]
    assert rows["not the same event and action, although the robots had acted alike"] == ["1"]


def test_mean_ratios_are_over_pairs_that_have_one() -> None:
    pairs = [
        a_pair("3", a_side(actions=2, plans=0), a_side(actions=3, plans=1)),
        a_pair("3", a_side(actions=4, plans=0), a_side(actions=2, plans=1)),
    ]
    ratios = evidence.mean_ratios(pairs)
    assert ratios["actions"] == pytest.approx((3 / 2 + 2 / 4) / 2)
    assert ratios["plans"] is None
    pairs = [*pairs, a_pair("3", a_side(actions=2), a_side(actions=0))]
    assert evidence.mean_ratios(pairs)["actions"] == pytest.approx((3 / 2 + 2 / 4 + 0) / 3)


def test_plans_are_counted_by_their_number() -> None:
    made = [2, 3, 2, 1]
    pairs = [a_pair("2", baseline=a_side(plans=plans)) for plans in made]
    assert list(evidence.plans_made(pairs).items()) == [(1, 1), (2, 2), (3, 1)]


SPLIT = [
    a_pair("3", a_side(actions=4), a_side(False, actions=1)),
    a_pair("3", a_side(actions=4), a_side(False, actions=3)),
    a_pair("3", a_side(actions=2), a_side(actions=5)),
    a_pair("4", a_side(actions=2), a_side(actions=3)),
    a_pair("4", a_side(actions=2), a_side(False, actions=3), intended="4"),
]


def test_rows_three_and_four_are_split_by_whether_the_traditional_robot_fails() -> None:
    page = row_by_row(SPLIT, WORLD)
    rows = _lines(page)
    assert rows["3, TP fails, ours (2)"][-1] == "0.50"
    assert rows["3, no failures, ours (1)"][-1] == "2.50"
    assert rows["4, TP fails, ours (0)"][-1] == "-"
    assert rows["4, no failures, ours (1)"][-1] == "1.50"
    assert rows["3, TP fails, published"][-1] == f"{(1.12 - 0.72 * 1.39) / 0.28:.2f}"
    assert says(page, 3, "67%", "28%", 4, "0%", "27%")


def test_row_two_says_how_often_the_place_it_is_in_comes_last() -> None:
    last, first = parsed(["exo_move(book2,library)", "exo_move(book2,kitchen)"])
    pairs = [
        a_pair("2", baseline=a_side(plans=3, event=last)),
        a_pair("2", baseline=a_side(plans=3, event=last), intended="2"),
        a_pair("2", baseline=a_side(plans=1, event=first)),
        a_pair("2", baseline=a_side(plans=7, event=None)),
        a_pair("1", baseline=a_side(plans=8, event=last)),
    ]
    # Plans, and pairs with so many; then how often the place comes last, and the published mean.
    assert says(row_by_row(pairs, WORLD), 1, 1, 3, 2, 2, 3, "2.63")
    assert "2.63" not in numbers(row_by_row([], WORLD))


def test_row_five_says_how_long_the_plans_were_and_where_the_event_ended() -> None:
    kitchen, office = parsed(["exo_move(book1,kitchen)", "exo_move(book1,office1)"])
    pairs = [
        a_pair("5", a_side(actions=9, event=kitchen), a_side(actions=4), intended="5"),
        a_pair("5", a_side(actions=12, event=kitchen), a_side(actions=5), intended="5"),
        a_pair("5", a_side(actions=7, event=office), a_side(actions=2)),
        a_pair("5", a_side(actions=99, event=office), a_side(actions=99), intended="2"),
    ]
    page = row_by_row(pairs, WORLD)
    assert says(page, "4.5", "10.5", 2, 2, "2.0", "7.0", 1, 1)
    assert page.index("kitchen 2") < page.index("office1 1")


def test_seconds_and_units_are_medians_of_the_random_pairs() -> None:
    minds = [
        a_side(planning_time=t, execution_units=u) for t, u in ((0.01, 30), (0.03, 90), (0.02, 75))
    ]
    assert says(row_by_row([a_pair("3", mind) for mind in minds], WORLD), 20, 75)


def test_the_even_average_and_the_weighted_one_are_those_of_the_published_rows() -> None:
    page = drawing(analysed(SPLIT))
    even = (0.81 + 3.06 + 0.81 + 1.00 + 0.18) / 5
    assert says(page, f"{even:.2f}", "1.00", "69%", "74%")
    rows = _lines(page)
    assert rows["published, from its own rows"] == ["7%", "7%", "52%", "32%", "3%"]


def test_shares_are_of_the_pairs_in_scenarios_one_to_five() -> None:
    pairs = [
        a_pair("3"),
        a_pair("3"),
        a_pair("3"),
        a_pair("1"),
        a_pair("6"),
        a_pair("nothing to do"),
    ]
    table = analysed(pairs).tables["random"]
    assert evidence.shares(table) == {"1": 0.25, "2": 0.0, "3": 0.75, "4": 0.0, "5": 0.0}
    assert _lines(drawing(analysed(pairs)))["random"] != []


def test_shares_of_no_pair_are_none() -> None:
    table = analysed([a_pair("6", intended="6")]).tables["triggered"]
    assert evidence.shares(table) == dict.fromkeys("12345", 0.0)


def test_what_became_what_is_counted_and_so_is_what_no_rule_fits() -> None:
    pairs = [a_pair("3"), a_pair("unclassified"), a_pair("unclassified", intended="4"), a_pair("4")]
    page = drawing(analysed(pairs))
    assert unclassified(analysed(pairs)) == 2
    assert numbers(page)[-1] == "2"
    head = next(line for line in page.splitlines() if line.startswith("| played as"))
    assert head.strip("| ").split(" | ") == ["played as", "3", "4", "unclassified"]
    assert "| random | 1 | 1 | 1 |" in page
    assert "| 4 | 0 | 0 | 1 |" in page


def test_what_lies_outside_is_named_with_both_values() -> None:
    pairs = [a_pair("1", baseline=a_side(actions=2), state=state) for state in ("a", "b")]
    missed = list(evidence.outside(analysed(pairs).tables["random"].rows))
    assert missed == [evidence.Outside("1", "actions", 2.0, PUBLISHED["1"].ratios["actions"])]


def test_how_soon_events_come_is_counted_in_the_main_run() -> None:
    late = a_side(before=("move(rob1,kitchen)", "move(rob1,library)"))
    main = [a_pair("3"), a_pair("3"), a_pair("3", late), a_pair("1", a_side(event=None))]
    config = load_config("table1", ["adversary.rate=0.3"])
    other = [a_pair("3", baseline=a_side(False)), a_pair("3")]
    run = Run(None, config, {"intentional": other}, {"intentional": analysed(other)})  # type: ignore[arg-type]
    page = later(run, main)
    assert says(page, 0.92, "67%", 0.3)
    assert _lines(page)["3"][:3] == ["2", _lines(page)["3"][1], "72%"]
    assert _lines(page)["3"][1].startswith("50.0%")


def test_a_run_without_random_pairs_has_no_such_section() -> None:
    triggered = [dataclasses.replace(pair, intended="3") for pair in SPLIT]
    analyses = {"intentional": analysed(triggered)}
    run = Run(None, CONFIG, {"intentional": triggered}, analyses)  # type: ignore[arg-type]
    assert later(run, triggered) == ""


def _unaided(minds: dict[str, list[Pair]]) -> str:
    return unaided(Run(None, CONFIG, minds, {}))  # type: ignore[arg-type]  # no folder


def _three(trial: str, happened: str, first: bool, second: bool, baseline: bool) -> dict[str, Pair]:
    """The pairs of two robots with the same trial of the traditional one."""
    other = a_side(baseline, trial=trial)
    return {
        "intentional": a_pair(happened, a_side(first, execution_units=40), other),
        "intentional-checking": a_pair("6", a_side(second, execution_units=50), other),
    }


def test_without_feedback_each_robot_is_counted_under_the_first_ones_scenario() -> None:
    threes = [
        _three("t1", "3", first=True, second=True, baseline=False),
        _three("t2", "3", first=False, second=True, baseline=False),
        _three("t3", "1", first=True, second=True, baseline=True),
    ]
    names = ("intentional", "intentional-checking")
    page = _unaided({name: [three[name] for three in threes] for name in names})
    rows = _lines(page)
    assert rows["random, 3"] == ["2", "50.0% (1)", "100.0% (2)", "0.0% (0)"]
    assert rows["random, 1"] == ["1", "100.0% (1)", "100.0% (1)", "100.0% (1)"]
    assert numbers(page)[-1] == "1.25"


def test_without_feedback_pairs_without_event_or_work_are_counted_apart() -> None:
    quiet, names = a_side(event=None), ("intentional", "intentional-checking")
    idle = a_side(event=None, trial="t3")
    own = {
        "intentional": [
            a_pair("3", a_side(False), a_side(trial="t1"), intended="3"),
            a_pair("1", quiet, a_side(trial="t2", event=None), intended="3", apart="no event"),
            a_pair("nothing to do", quiet, idle, apart="nothing to do"),
            a_pair("1", quiet, a_side(trial="t4", event=None)),
        ]
    }
    own[names[1]] = [dataclasses.replace(pair, treatment=a_side()) for pair in own[names[0]]]
    page = _unaided(own)
    rows = _lines(page)
    assert rows["triggered, 3"] == ["1", "0.0% (0)", "100.0% (1)", "100.0% (1)"]
    assert rows["random, 1"] == ["1", "100.0% (1)", "100.0% (1)", "100.0% (1)"]
    assert "random, nothing to do" not in rows
    assert says(page, 1, 1)
    assert page.index("no event") < page.index("nothing to do")


def _heeding(relevance: str, actions: int) -> Run:
    """Locks, of which one run takes so many actions, and a book that was moved: always 8."""
    own = [
        *(a_pair("6", a_side(actions=taken, execution_units=90)) for taken in (8, actions)),
        a_pair("3", a_side(actions=8, execution_units=90)),
    ]
    config = CONFIG.model_copy(update={"relevance": relevance})
    return Run(None, config, {"intentional": own}, {})  # type: ignore[arg-type]  # no folder


def test_what_another_relevance_changes_is_told_row_by_row() -> None:
    usual = _heeding("published", 9)
    page = heeding(_heeding("definition", 7), usual)
    table = [line.strip("| ").split(" | ") for line in page.splitlines() if line.startswith("| ")]
    assert [[cell.strip() for cell in row] for row in table[2:]] == [
        ["random, 6", relevance, "2", "100.0% (2)", "1.00", actions, "90.00"]
        for relevance, actions in (("published", "8.50"), ("definition", "7.50"))
    ]
    assert says(page, 1, 1)
    assert not _lines(heeding(_heeding("definition", 9), usual))


def test_why_nothing_is_missed_is_said_only_where_nothing_is() -> None:
    achieved = [pair for pair in SPLIT if pair.treatment.achieved]
    failed = [*achieved, a_pair("3", a_side(False))]
    all_of_them, others = (_unaided({"intentional": pairs}) for pairs in (achieved, failed))
    assert len(all_of_them.split("\n\n")) == len(others.split("\n\n")) + 1
