"""The digest of a run's results: what it depends on, and what it does not."""

import pytest

from testbed.experiment.digest import digest
from testbed.experiment.record import TIMES
from tests.experiment.samples import a_record

ONE, OTHER = a_record("a"), a_record("b", achieved=False)


def test_the_order_of_the_records_makes_no_difference() -> None:
    assert digest([ONE, OTHER]) == digest([OTHER, ONE])


@pytest.mark.parametrize("time", [name for name in TIMES if name != "infer_time_s"])
def test_times_make_no_difference(time: str) -> None:
    assert digest([a_record("a", **{time: 3.5}), OTHER]) == digest([ONE, OTHER])


@pytest.mark.parametrize(
    "changed",
    [{"achieved": False}, {"steps": 1}, {"reason": "why"}, {"minimal_units": 5}, {"trial": "c"}],
)
def test_any_result_makes_one(changed: dict[str, object]) -> None:
    assert digest([a_record(**({"trial": "a"} | changed)), OTHER]) != digest([ONE, OTHER])  # type: ignore[arg-type]


def test_a_missing_and_a_doubled_record_make_one() -> None:
    assert len({digest([]), digest([ONE]), digest([ONE, ONE]), digest([ONE, OTHER])}) == 4
