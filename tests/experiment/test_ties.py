"""Of equally small explanations a robot adopts the first in the order that it is given."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from testbed.analysis import load_run
from testbed.config import ConfigError, load_config
from testbed.experiment.record import TrialRecord
from testbed.experiment.runner import run

SHIP = """\
sorts
  robot = {mate}.
  crate = {tea}.
  deck  = {bow, hold, poop, stern, waist}.
fluents
  inertial at(robot, deck).
  inertial lies(crate, deck).
actions
  agent     walk(robot, deck).
  agent     shove(robot, crate, deck).
  exogenous slide(crate, deck).
laws
  walk(R, D)     causes at(R, D).
  shove(R, C, D) causes lies(C, D).
  shove(R, C, D) causes at(R, D).
  slide(C, D)    causes lies(C, D).
  -at(R, D2)   if at(R, D1), D1 != D2.
  -lies(C, D2) if lies(C, D1), D1 != D2.
  impossible walk(R, D)     if at(R, D).
  impossible shove(R, C, D) if lies(C, D).
  impossible shove(R, C, D) if at(R, D1), -lies(C, D1).
  impossible slide(C, D)    if lies(C, D).
sees
  R sees at(R, D)   if robot(R).
  R sees lies(C, D) if at(R, D).
"""
"""The crate slides away unseen: it can be on any other deck."""
CONFIG = """\
name: ship
domain: ship.al
goal: ["lies(tea,bow)"]
initial: ["at(mate,bow)", "lies(tea,hold)"]
robots: [intentional, intentional-plain, traditional, traditional-plain]
script: [{at_action: 1, action: "slide(tea,stern)"}]
link: inprocess
sweep: {grid: {ties: [null, 0, 1, 2, 3, 4, 5, 6, 7]}}
"""
DECLARED = "slide(tea,bow)"
"""The first one that can have happened."""
Played = dict[tuple[int | None, str], TrialRecord]


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> Played:
    folder = tmp_path_factory.mktemp("ship")
    (folder / "ship.al").write_text(SHIP, encoding="utf-8")
    (folder / "ship.yaml").write_text(CONFIG, encoding="utf-8")
    assert run(load_config(folder / "ship.yaml"), folder / "run", workers=0).exit_code == 0
    records = load_run(folder / "run").records()
    return {(r.condition.ties if r.condition else None, r.robot): r for r in records}


def _adopted(record: TrialRecord) -> Sequence[str]:
    """What the first explanation assumes."""
    return [event.action for event in record.explanations[0].unobserved]


@pytest.mark.parametrize("robot", ["intentional", "traditional"])
def test_every_order_gives_an_explanation_of_one_event_and_some_another(
    played: Played, robot: str
) -> None:
    adopted = {ties: _adopted(own) for (ties, name), own in played.items() if name == robot}
    assert {len(events) for events in adopted.values()} == {1}
    assert adopted[None] == [DECLARED]
    assert len({*map(tuple, adopted.values())}) > 1


@pytest.mark.parametrize("robot", ["intentional", "traditional"])
def test_the_incremental_way_and_the_one_from_scratch_obey_it_alike(
    played: Played, robot: str
) -> None:
    ours, theirs = (
        {
            ties: (own.explanations, own.actions)
            for (ties, who), own in played.items()
            if who == name
        }
        for name in (robot, f"{robot}-plain")
    )
    assert ours == theirs


def test_robots_have_the_same_order(played: Played) -> None:
    for (ties, _), record in played.items():
        assert _adopted(record) == _adopted(played[ties, "intentional"])


@pytest.mark.parametrize("value", ["first", "-1", "0.5", "true"])
def test_what_is_no_seed_is_refused(tmp_path: Path, value: str) -> None:
    (tmp_path / "ship.al").write_text(SHIP, encoding="utf-8")
    (tmp_path / "ship.yaml").write_text(CONFIG.partition("sweep")[0], encoding="utf-8")
    with pytest.raises(ConfigError) as refused:
        load_config(tmp_path / "ship.yaml", [f"ties={value}"])
    (line,) = refused.value.lines
    assert "ties" in line
