"""What a run says of itself where nobody watches a terminal."""

import pytest

from testbed.experiment import RunStatus
from testbed.experiment.progress import EVERY_S, Lines, progress


def _told(*moments: tuple[float, int, int], planned: int = 8000) -> list[str]:
    """The lines said for moments `(second, trials done, trials failed)`."""
    said: list[str] = []
    now = 0.0
    lines = Lines(said.append, lambda: now)
    for now, done, failed in moments:  # noqa: B007  # the clock reads it
        lines.notify(RunStatus(planned, done, failed))
    return said


def test_a_line_says_how_far_how_fast_and_how_long() -> None:
    assert _told((0.0, 0, 0), (EVERY_S, 600, 0)) == ["600 of 8000 trials, 20.0/s, 0:06:10 left"]


def test_the_rate_of_a_resumed_run_is_that_of_its_own_trials() -> None:
    assert _told((5.0, 7000, 2), (65.0, 7060, 2)) == [
        "7060 of 8000 trials, 2 failed, 1.0/s, 0:15:40 left"
    ]


def test_hours_are_told() -> None:
    assert _told((0.0, 0, 0), (100.0, 100, 0))[0].endswith("2:11:40 left")


def test_lines_are_apart_however_fast_trials_end() -> None:
    moments = [(float(second), second, 0) for second in range(round(EVERY_S) * 3 + 1)]
    assert [line.split()[0] for line in _told(*moments)] == ["30", "60", "90"]


def test_a_quiet_run_and_a_short_one_say_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    for quiet in (True, False):
        with progress(quiet) as notify:
            notify(RunStatus(2, 0, 0))
            notify(RunStatus(2, 2, 0))
    assert capsys.readouterr().err == ""
