"""A run on a cluster of which parts are killed gives, once it is done, what any other gives."""

from collections import Counter

import pytest

from benchmarks import chaos

pytestmark = pytest.mark.load


def test_whatever_is_killed_a_run_ends_with_each_trial_once() -> None:
    (sheet,) = chaos.main("small")
    found = {str(row["count"]): row["number"] for row in sheet.rows}
    faults = Counter(chaos.FAULTS["small"].values())
    assert found["workers_killed"] == faults["worker"] == 2
    assert found["schedulers_restarted"] == faults["scheduler"] == 1
    assert found["drivers_killed"] == faults["driver"] == 2
    # A driver ends with its scheduler, and no trial fails.
    assert found["resumed"] == faults["driver"] + faults["scheduler"]
    assert found["failed_and_retried"] == 0
    assert (found["unlike_named"], found["unlike_executions"]) == (1, 0)
    assert (found["trials"], found["lost"], found["duplicates"]) == (24, 0, 0)
    assert (found["stories"], found["equal"]) == (24, True)
    # Each worker was killed in the middle of a trial, which another one began again.
    assert int(str(found["executions"])) >= 24 + faults["worker"]
