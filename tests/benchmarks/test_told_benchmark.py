"""The robot that is told when it explains too well, and its run beside the one it comes from."""

from pathlib import Path

import msgspec
import pytest

from asp.language import Literal
from benchmarks.told import ToldRobot, main, reordered
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import read_config, write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.store import read_records
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.world import load_world

DOMAIN = load_world("office").description
FIRST = ("library", "kitchen", "office2", "office1")
START = "[loc(rob1,office2), loc(book1,library), loc(book2,kitchen)]"


def _played(robot: ToldRobot, *events: tuple[int, str]) -> TrialRecord:
    config = load_config("table1", ["scenarios=[1]", f"initial={START}", "robots=[traditional]"])
    (spec,) = plan_trials(config)
    script = tuple((step, Literal.parse(event)) for step, event in events)
    spec = msgspec.structs.replace(
        spec, setting=msgspec.structs.replace(spec.setting, script=script)
    )
    return play_trial(spec, InProcessRobot(lambda _: robot)).record


def test_a_sort_declares_its_members_in_another_order() -> None:
    text = reordered(DOMAIN, FIRST)
    assert "room = {library, kitchen, office2, office1}." in text
    assert len(text.splitlines()) == len(DOMAIN.source.splitlines())
    assert reordered(DOMAIN, ()) == DOMAIN.source
    with pytest.raises(ValueError, match="no sort of the domain has the members kitchen"):
        reordered(DOMAIN, ["kitchen"])


def test_told_that_its_explanation_is_wrong_it_takes_another_one() -> None:
    """Book 2 is gone from the kitchen; that it is in the library would be the end of it."""
    record = _played(ToldRobot(FIRST), (1, "exo_move(book2,office1)"))
    assert record.achieved
    assert next(e.unobserved[-1].action for e in record.explanations) == "exo_move(book2,library)"
    assert [at.action for at in record.mental] == ["finish", "finish"]


def test_where_the_goal_holds_as_it_explains_nothing_is_told() -> None:
    record = _played(ToldRobot(FIRST), (1, "exo_move(book2,library)"))
    assert (record.outcome, len(record.explanations), record.plans) == ("achieved", 1, 1)


def test_at_the_end_of_a_plan_it_heeds_nothing() -> None:
    record = _played(ToldRobot(FIRST), (4, "exo_move(book1,kitchen)"))
    assert (record.achieved, record.outcome) == (False, "false_finish")


def test_its_run_has_the_other_trials_as_they_are(tmp_path: Path) -> None:
    folder, out = tmp_path / "run", tmp_path / "told"
    config = load_config("table1", ["scenarios=[1, random]", "limit=4", "scenario_settings={}"])
    write_config(folder, config)
    play_missing(config, folder, 1, lambda _: None)
    assert main([str(folder), str(out), "--order", *FIRST]) == 0
    before = {r.trial: r for r in read_records(folder) if r.scenario == "random"}
    after = {r.trial: r for r in read_records(out)}
    assert set(after) == set(before)
    for trial, record in after.items():
        if record.robot == "intentional":
            assert record == before[trial]
        assert record.exogenous == before[trial].exogenous
    assert read_config(out).name == "told-library-kitchen-office2-office1"


def test_bad_input_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(tmp_path), str(tmp_path / "out")]) == 2
    assert "is not a run folder" in capsys.readouterr().err
    write_config(tmp_path, load_config("table1", ["limit=1"]))
    assert main([str(tmp_path), str(tmp_path / "out"), "--order", "attic"]) == 2
    assert "--order: no sort" in capsys.readouterr().err
