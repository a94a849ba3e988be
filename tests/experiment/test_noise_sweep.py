"""A sweep over noise, in several domains: it costs steps and success, and no trial is an error."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from asp.domains import LEVELS, level_text
from asp.refinement import load
from benchmarks.own import Own
from testbed.experiment.record import TrialRecord
from testbed.world import world_of
from tests.experiment.gardens import GARDEN, PIECES, ROWS

HERE = Path(__file__).parents[1] / "asp" / "refinement"
NOISE = (0.2, 0.5, 1.0)


@dataclass(frozen=True)
class Field:
    """A domain with its refinement, and a goal that trials draw."""

    domain: str
    refinement: str
    goal: tuple[str, ...]

    def noisy(self, right: float) -> dict[str, float]:
        """Statistics by which everything comes out right with one probability."""
        refinement = load(self.domain, "own.al", self.refinement, "own.fine")
        actions = {each.name for each in world_of(refinement).agent_actions}
        strong = refinement.strong_signature.symbols.values()
        tests = {symbol.name for symbol in strong if symbol.name.startswith("test_")}
        return dict.fromkeys(sorted(actions | tests), right)

    def played(self, folder: Path, right: float, limit: int = 3) -> Sequence[TrialRecord]:
        own = Own(folder, self.domain, self.refinement)
        trials = own.play(
            draw={"goal": list(self.goal), "holding": 0.5},
            statistics=self.noisy(right),
            adversary={"strategy": "random", "rate": 0.0},
            limits={"steps": 120},
            robots=["intentional"],
            limit=limit,
        )
        return [record for record, _ in trials]


def _level(label: str) -> Field:
    size = LEVELS[label]
    coarse, fine = level_text(size.rooms, size.rows, size.columns, size.objects)
    refined = fine.replace("refines level.", 'refines "own.al".')
    return Field(coarse, refined, ("loc(object,room)", "-in_hand(robot,object)"))


def _stored(label: str, *goal: str) -> Field:
    coarse, fine = (HERE / f"{label}{kind}" for kind in (".al", ".fine"))
    refined = fine.read_text(encoding="utf-8").replace(f"{label}.al", "own.al")
    return Field(coarse.read_text(encoding="utf-8"), refined, goal)


def _garden(refinement: str, still: bool = False) -> Field:
    """The garden; in a `still` one nothing happens but what the helper does."""
    coarse, fine = (text.replace("OTHER", "rake") for text in (GARDEN, refinement))
    if still:
        coarse = "\n".join(line for line in coarse.splitlines() if "stray" not in line)
        fine = fine.replace(" stray.", "")
    return Field(coarse, fine, ("stands(tool,bed)", "-carries(helper,tool)"))


FIELDS = {
    "level L1": _level("L1"),
    "level L2": _level("L2"),
    "tabletop": _stored("tabletop", "lies(block,zone)", "-held(arm,block)"),
    "garden": _garden(PIECES),
    "garden of beds alone": _garden(ROWS),
    "still garden": _garden(PIECES, still=True),
}


@pytest.mark.parametrize("field", FIELDS)
def test_noise_costs_steps_and_success_and_is_no_error(field: str, tmp_path: Path) -> None:
    costs = []
    for right in NOISE:
        records = FIELDS[field].played(tmp_path, right)
        outcomes = {record.outcome for record in records}
        assert outcomes <= {"achieved", "step_limit", "gave_up", "false_finish"}
        costs.append(sum(record.steps for record in records))
    assert outcomes == {"achieved"}
    assert costs[0] > costs[-1]
