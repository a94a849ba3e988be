"""What explains the levels' differences, against pairs made by hand."""

import pytest

from papers.levels import evidence
from papers.levels.pairing import Meeting, Pair, pairs_in
from testbed.analysis.bootstrap import Estimate
from testbed.analysis.table import table_of
from testbed.experiment.record import Attempt, Explained, Occurrence, TrialRecord
from testbed.studies import Cell, Rounded
from testbed.studies.levels.published import NO_ZOOM, OWN, PAPER, ZOOM
from testbed.studies.levels.tables import Row
from tests.experiment.samples import a_level_record, a_record

ROBOTS = (ZOOM, NO_ZOOM)
MOVE, OTHER = "fine_exo_move(object1_1,room1_1)", "fine_exo_move(object1_1,room1_2)"


def _trial(robot: str, *events: tuple[int, str], pair: str = "p", **values: object) -> TrialRecord:
    exogenous = [Occurrence(step, action, False) for step, action in events]
    given: dict[str, object] = {"steps": 9, "actions": [Attempt(3, "move(rob1,room1)", True)]}
    return a_level_record(pair, robot, exogenous=exogenous, **given | values)


def _pair(zoom: TrialRecord, no_zoom: TrialRecord) -> Pair:
    (pair,) = pairs_in(table_of([zoom, no_zoom]))
    return pair


@pytest.mark.parametrize(
    ("zoom", "no_zoom", "meeting"),
    [
        ((), (), "nothing"),
        (((2, MOVE),), ((2, MOVE),), "same"),
        (((2, MOVE), (5, OTHER)), ((2, MOVE), (5, OTHER)), "same"),
        (((2, MOVE),), ((3, MOVE),), "other"),
        (((2, MOVE),), ((2, OTHER),), "other"),
        (((2, MOVE),), (), "other"),
        (((2, MOVE), (5, OTHER)), ((2, MOVE),), "other"),
    ],
)
def test_whether_both_met_the_same(
    zoom: tuple[tuple[int, str], ...], no_zoom: tuple[tuple[int, str], ...], meeting: Meeting
) -> None:
    assert _pair(_trial(ZOOM, *zoom), _trial(NO_ZOOM, *no_zoom)).meeting == meeting


@pytest.mark.parametrize(
    ("events", "meeting"),
    [
        (((2, MOVE), (10, OTHER)), "longer"),
        (((2, MOVE), (9, OTHER)), "other"),
        (((10, MOVE),), "other"),
    ],
)
def test_what_comes_after_the_others_end_is_told_apart(
    events: tuple[tuple[int, str], ...], meeting: Meeting
) -> None:
    short, long = _trial(ZOOM, (2, MOVE)), _trial(NO_ZOOM, *events, steps=12)
    assert _pair(short, long).meeting == meeting


def test_pairs_are_joined_in_any_order_and_others_are_passed_over() -> None:
    zoom, no_zoom = _trial(ZOOM), _trial(NO_ZOOM)
    third = _trial("traditional", pair="p")
    coarse = a_record("p2", robot=ZOOM)
    for records in ([zoom, third, no_zoom], [coarse, no_zoom, zoom]):
        (pair,) = pairs_in(table_of(records))
        assert (pair.zoom.trial, pair.no_zoom.trial) == (zoom.trial, no_zoom.trial)
    assert list(pairs_in(table_of([zoom, third]))) == []


def test_it_is_counted_who_met_and_did_the_same() -> None:
    did = [Attempt(2, "move(rob1,room2)", True)]
    pairs = [
        _pair(_trial(ZOOM), _trial(NO_ZOOM)),
        _pair(_trial(ZOOM, (2, MOVE)), _trial(NO_ZOOM, (2, MOVE), goal=["loc(object1,room2)"])),
        _pair(_trial(ZOOM, (2, MOVE), actions=did), _trial(NO_ZOOM, (2, OTHER))),
        _pair(_trial(ZOOM, initial=["fine_loc(rob1,room1_1)"]), _trial(NO_ZOOM, steps=10)),
    ]
    met = evidence.met(pairs)
    assert (met.pairs, met.starts, met.goals, met.alike) == (4, 3, 3, 2)
    assert met.meetings == {"nothing": 2, "same": 1, "longer": 0, "other": 1}
    assert met.same_events == 3


def test_as_many_refined_plans_concrete_actions_and_tests_belong_to_the_same_work() -> None:
    for count in ("plans", "actions", "tests"):
        more = _trial(NO_ZOOM)
        assert more.fine is not None
        assert _pair(_trial(ZOOM), more).alike
        setattr(more.fine, count, 7)
        assert not _pair(_trial(ZOOM), more).alike


def _coarse(times: float, seed: int, **values: object) -> Pair:
    """No zoom takes so many times as long at the coarse resolution."""
    whole = _trial(NO_ZOOM, seed=seed, planning=0.5 * times, diagnosis=0.0, **values)
    return _pair(_trial(ZOOM, seed=seed, planning=0.5, diagnosis=0.0), whole)


def test_scatter_has_the_means_both_ways_round_and_who_was_first() -> None:
    pairs = [_coarse(0.5, 0), _coarse(2.0, 1), _coarse(4.0, 3), _coarse(9.0, 2, steps=10)]
    scatter = evidence.scatter(pairs, ROBOTS)
    assert scatter is not None
    assert scatter.pairs == 3  # the last did not do the same
    assert scatter.mean == pytest.approx(6.5 / 3)
    assert scatter.inverse == pytest.approx(2.75 / 3)
    assert scatter.median == pytest.approx(2.0)
    # An even seed lets the first robot of the list play first.
    assert (scatter.zoom_first, scatter.no_zoom_first) == (pytest.approx(0.5), pytest.approx(3.0))
    assert evidence.scatter(pairs[3:], ROBOTS) is None


def test_the_published_number_of_plans_is_what_would_fill_the_published_time() -> None:
    pairs = [_coarse(1.0, 0), _coarse(1.0, 1)]
    work = evidence.work(pairs, "L1", PAPER)
    assert (work.plans, work.abstract) == (2.0, 1.0)
    assert work.seconds == pytest.approx(0.1)
    assert work.implied == pytest.approx(1.57 / 0.37)
    assert work.published == 0.37
    assert evidence.work(pairs, "L1", OWN).implied is None


def test_trials_that_explain_something_are_told_apart() -> None:
    explained = [Explained(3, [], [])]
    calm = _pair(_trial(ZOOM, (1, MOVE), (2, OTHER), planning=0.1), _trial(NO_ZOOM))
    other = _pair(_trial(ZOOM, planning=0.6, explanations=explained), _trial(NO_ZOOM))
    surprise = evidence.surprise([calm, calm, other])
    assert (surprise.trials, surprise.calm) == (3, 2)
    assert surprise.events == pytest.approx(4 / 3)
    assert (surprise.seconds, surprise.others) == (pytest.approx(0.5), pytest.approx(1.0))
    assert evidence.surprise([calm]).others is evidence.surprise([other]).seconds is None


def test_only_cells_with_both_values_are_counted() -> None:
    ours = Estimate(1.5, 1.3, 1.7)
    cells = (
        Cell(ours, published=Rounded(1.4)),
        Cell(ours, published=Rounded(2.0)),
        Cell(ours),
        Cell(None, published=Rounded(2.0)),
    )
    counted = evidence.inside([Row("L1", ZOOM, 1, cells), Row("L2", ZOOM, 1, cells[:1])])
    assert (counted.inside, counted.values) == (2, 3)
