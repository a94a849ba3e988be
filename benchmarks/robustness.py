"""What stress searches find in the packaged robots: episodes, failures, the shortest stories."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.sheets import Row, Sheet
from testbed.config import ExperimentConfig, load_config
from testbed.stress.catalogue import Kind
from testbed.stress.running import Status, search

THEORY = ("intentional", "intentional-checking")
TOLD = (
    "{}",
    *(f"{{exo_move: {{mode: {m}}}, exo_lock: {{mode: {m}}}}}" for m in ("colocated", "always")),
)
FEEDBACK = "goal_feedback: [true, false]"


@dataclass(frozen=True)
class Hunt:
    """A search: a configuration with what is changed in it, and its minutes at full size."""

    config: str
    robots: Sequence[str]
    minutes: float
    events: int
    grid: str = FEEDBACK
    more: Sequence[str] = ()

    def loaded(self, size: str) -> ExperimentConfig:
        """The configuration; at small size a case per condition, few episodes, and a second."""
        full = size == "full"
        return load_config(
            self.config,
            [
                f"robots=[{', '.join(self.robots)}]",
                f"sweep.grid={{{self.grid}}}",
                "stress.objectives=[fail, principles]",
                f"stress.events={self.events if full else 1}",
                f"stress.minutes={self.minutes if full else 1 / 60}",
                *self.more,
                *([] if full else ["limit=1", "stress.branches=4"]),
            ],
        )


HUNTS: Mapping[str, Hunt] = {
    "office": Hunt(
        "stress", THEORY, 36, 4, f"observability: [{', '.join(TOLD)}], {FEEDBACK}", ["limit=8"]
    ),
    "hospital": Hunt("hospital", THEORY, 30, 4, more=["scenarios=[quiet]", "repeats=1"]),
    "library": Hunt("library", THEORY, 18, 4),
    "levels": Hunt(
        "levels",
        ["intentional"],
        24,
        3,
        "relevance: [definition, published]",
        [
            "levels=[L1, L2, L3]",
            "limit=2",
            "stress.branches=100",
            "adversary.rate=0",
            "statistics={}",
        ],
    ),
    "joint": Hunt("stress", ["intentional-joint-staged"], 12, 2, more=["limit=1"]),
}


def main(size: str) -> list[Sheet]:
    """Sheets `robustness` and `robustness_kinds`."""
    found = {}
    with TemporaryDirectory() as folder:
        for name, hunt in HUNTS.items():
            own = Path(folder) / name
            own.mkdir()
            found[name] = search(hunt.loaded(size), own, 1, lambda _: None)
    return sheets(found)


def sheets(found: Mapping[str, Status]) -> list[Sheet]:
    """The tables of searches by their names."""
    played = [row for name, status in found.items() for row in _played(name, status)]
    kinds = [row for name, status in found.items() for row in _kinds(name, status)]
    return [
        Sheet("robustness", "Episodes in which robots were looked for to fail", played, NOTES),
        Sheet("robustness_kinds", "What was found", kinds),
    ]


NOTES = (
    "fair events; one event: all that are legal in each case; objectives: failures and principles;",
    "with_findings: episodes in which something was found",
)


def _played(name: str, status: Status) -> Iterator[Row]:
    counts = status.catalogue
    groups = sorted({(own.robot, own.events) for own in counts.episodes})
    for robot, events in groups:
        own = [each for each in counts.episodes if (each.robot, each.events) == (robot, events)]
        yield {
            "search": name,
            "robot": robot,
            "events": events,
            "episodes": sum(counts.episodes[each] for each in own),
            "with_findings": sum(counts.failed[each] for each in own),
        }


def _kinds(name: str, status: Status) -> Iterator[Row]:
    counts, families = status.catalogue, dict[tuple[str, str, str], list[Kind]]()
    for kind in counts.kinds:
        families.setdefault(kind[:3], []).append(kind)
    for (robot, objective, rule), own in sorted(families.items()):
        shortest = min((counts.kinds[kind] for kind in own), key=lambda each: each[:4])
        yield {
            "search": name,
            "robot": robot,
            "objective": objective,
            "rule": rule,
            "episodes": sum(counts.met[kind] for kind in own),
            "fewest_events": shortest.events,
            "fewest_steps": shortest.length,
            "conditions": "; ".join(sorted(set().union(*(counts.under[kind] for kind in own)))),
        }
