"""A run on a cluster of which parts are killed gives, once it is done, what any other gives."""

from collections import Counter

import pytest

from benchmarks import chaos

pytestmark = pytest.mark.load


def test_whatever_is_killed_a_run_ends_with_each_trial_once() -> None:
    (sheet,) = chaos.main("small")
    found = {str(row["count"]): row["number"] for row in sheet.rows}
    faults = Counter(chaos.FAULTS["small"].values())
    # A worker is spared at a record that comes while no other one plays.
    assert 1 <= int(str(found["workers_killed"])) <= faults["worker"] == 2
    assert found["schedulers_restarted"] == faults["scheduler"] == 1
    assert found["drivers_killed"] == faults["driver"] == 2
    again = int(str(found["failed_and_retried"]))  # as trials may that a busy machine ends
    assert int(str(found["resumed"])) >= faults["driver"] + again
    assert (found["unlike_named"], found["unlike_executions"]) == (1, 0)
    assert (found["trials"], found["lost"], found["duplicates"]) == (24, 0, 0)
    assert (found["stories"], found["equal"]) == (24, True)
    assert int(str(found["executions"])) >= 24
