"""The released draw of runs that were played: its weights by hand, and its section of the page."""

from pathlib import Path

import pytest

from papers.table1.__main__ import main
from papers.table1.document import Sources, document
from papers.table1.hypotheses import weigh
from papers.table1.runs import Run, read_run, released_weights
from papers.table1.weighing import Weighing
from testbed.config import load_config
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.store import read_records
from testbed.studies.table1.published import SCENARIOS
from tests.papers.prose import numbers

HOLDING = "[loc(rob1,kitchen), 'in_hand(rob1,book1)', loc(book1,kitchen), loc(book2,office2)]"
MIND = "intentional"
RATE, OTHER_RATE = 0.4, 0.6


def _run(folder: Path, *overrides: str) -> Run:
    given = ["scenarios=[random]", "scenario_settings={random: {repeats: 24}}", "seed=1"]
    config = load_config("table1", [*given, f"initial={HOLDING}", *overrides])
    write_config(folder, config)
    play_missing(config, folder, 1, lambda _: None)
    return read_run(folder)


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> tuple[Run, Run]:
    """The same pairs at two rates."""
    folder = tmp_path_factory.mktemp("runs")
    return (
        _run(folder / "main", f"adversary.rate={RATE}"),
        _run(folder / "variant", f"adversary.rate={OTHER_RATE}", "name=variant"),
    )


def _by_hand(record: TrialRecord, rate: float) -> float | None:
    """The weight of a trial whose event comes while book 1 is held: beside its first two actions.

    Of three things one is drawn. As stated, book 1 is a draw in vain, so that nothing happens with
    1 - 2/3 rate; else it passes the draw on to book 2, and nothing happens with 1 - rate.
    """
    if not record.exogenous or record.exogenous[0].step > 3:
        return None
    event = record.exogenous[0]
    waited = (1 - rate) / (1 - rate * 2 / 3)
    return waited ** (event.step - 2) * (2.0 if "book2" in event.action else 1.0)


@pytest.mark.parametrize(("number", "rate"), [(0, RATE), (1, OTHER_RATE)])
def test_the_weights_of_trials_are_those_worked_out_by_hand(
    runs: tuple[Run, Run], number: int, rate: float
) -> None:
    weights = released_weights(runs[number], MIND)
    records = [r for r in read_records(runs[number].folder) if r.robot == MIND]
    expected = {r.trial: w for r in records if (w := _by_hand(r, rate)) is not None}
    assert {trial: weights[trial] for trial in expected} == pytest.approx(expected)
    assert len({round(w, 6) for w in expected.values()}) >= 3
    assert set(weights) == {record.trial for record in records}


def _weighed(run: Run) -> Weighing:
    weights = released_weights(run, MIND)
    return weigh(run.pairs[MIND], lambda pair: weights[pair.treatment.trial])


def _cells(page: str, name: str) -> list[str]:
    (line,) = (line for line in page.splitlines() if line.startswith(f"| {name} |"))
    return line.strip("| ").split(" | ")[1:]


def _shares(weighed: Weighing) -> str:
    return " ".join(f"{100 * weighed.shares[name]:.0f}" for name in SCENARIOS) + "%"


def test_the_page_weighs_each_run_by_its_own_weights(runs: tuple[Run, Run]) -> None:
    page = document(Sources(runs[0], variants=(runs[1],)))
    for run, plain, redrawn in (
        (runs[0], "as played", "released draw"),
        (runs[1], "variant", "variant; released draw"),
    ):
        assert _shares(_weighed(run)) in _cells(page, redrawn)
        assert _cells(page, plain) != _cells(page, redrawn)


def test_the_section_is_of_the_weighed_pairs(runs: tuple[Run, Run]) -> None:
    page = document(Sources(runs[0]))
    section = page.split("## The draw of the released simulator")[1].split("\n## ")[0]
    weighed = _weighed(runs[0])
    assert weighed.worth < len(runs[0].pairs[MIND]) - 1
    assert f"{weighed.worth:.0f}" in numbers(section)
    for name in SCENARIOS:
        if weighed.shares[name]:
            share = section.split(f"\n| {name} | ")[1].split(" | ")[0]
            assert share == f"{100 * weighed.shares[name]:.0f}%"


def test_where_events_come_while_the_robot_thinks_nothing_is_weighed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = _run(tmp_path, "exogenous_while_thinking=true", "adversary.rate=0.5")
    assert released_weights(run, MIND) == {}
    assert main([str(tmp_path), "--variant", str(tmp_path)]) == 0
    page = capsys.readouterr().out
    assert "| as played |" in page
    assert "released draw" not in page
    assert "## The draw of the released simulator" not in page


@pytest.mark.parametrize(
    "overrides", [["scenario_settings={random: {exogenous_while_thinking: true}}"], ["script=[]"]]
)
def test_other_ways_of_drawing_are_not_weighed(runs: tuple[Run, Run], overrides: list[str]) -> None:
    config = load_config("table1", ["scenarios=[random]", *overrides])
    other = Run(runs[0].folder, config, runs[0].pairs, runs[0].analyses)
    assert released_weights(other, MIND) == {}
