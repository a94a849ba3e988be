"""What is kept of refinements: of the last ones, within one bound, and freed at once."""

import gc
from weakref import ref

import pytest

from agents.intentional import IntentionalRobot
from agents.intentional.executor import model
from agents.intentional.executor.model import FineModel, fine_model
from agents.intentional.refined import RefinedRobot
from asp.domains import level_text
from asp.reasoning.fine_planning import Horizons, incremental
from asp.reasoning.fine_planning.compact_session import Horizon
from asp.refinement import Refinement, load
from asp.solving import Recent
from tests.agents.intentional.executor.faulty_world import TEXTS, play
from tests.literals import parsed

GOAL = parsed(["loc(object1,room2)"])
CELLS = range(2, 6)


def _row(cells: int) -> Refinement:
    """Two rooms of so many cells in a row, and one object."""
    coarse, fine = level_text(2, 1, cells, ((1, 1),))
    refinement = load(coarse, "faulty.al", fine, "faulty.fine")
    TEXTS[refinement] = fine
    return refinement


def _played(refinement: Refinement) -> ref[FineModel]:
    """The model with which an object was taken from one room to the next."""
    initial = parsed(["fine_loc(rob1,room1_1)", "fine_loc(object1_1,room1_2)"])
    assert play(RefinedRobot(IntentionalRobot()), refinement, initial, GOAL).achieved
    return ref(fine_model(refinement))


@pytest.mark.usefixtures("uncollected")
def test_of_many_refinements_the_last_ones_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(model, "_MODELS", Recent(2))
    kept = [_played(_row(cells)) for cells in CELLS]
    assert [found() is None for found in kept] == [True, True, False, False]
    assert fine_model(_row(CELLS[-1])) is kept[-1]()


def test_controls_of_all_refinements_have_one_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    horizons = Horizons(20)
    monkeypatch.setattr(incremental, "_HORIZONS", horizons)
    monkeypatch.setattr(model, "_MODELS", Recent(len(CELLS)))
    gc.collect()
    before = len(_horizons())
    for cells in CELLS:
        _played(_row(cells))
        assert len(horizons) == 1 or horizons.weight <= 20
        assert len(_horizons()) - before == len(horizons)


def _horizons() -> list[Horizon]:
    return [found for found in gc.get_objects() if isinstance(found, Horizon)]
