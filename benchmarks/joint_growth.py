"""How a decision grows with history, explanations and plan: TI beside ATI, and what is solved."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from math import inf
from pathlib import Path
from typing import Any
from unittest.mock import patch

import clingo
from clingo import Symbol
from matplotlib.figure import Figure

from agents.intentional import joint, reasoners
from agents.intentional.activities import History
from agents.intentional.joint import JointReasoner, StagedJointReasoner
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Reasoner
from asp.language import Literal
from asp.reasoning import Knowledge
from asp.reasoning.diagnosis import reference as diagnosis
from asp.solving import ground
from benchmarks import one_call
from benchmarks.measuring import forget, no_collection, timed, within
from benchmarks.one_call import OneCallReasoner
from benchmarks.sheets import Row, Sheet, Value, gathered
from benchmarks.vanished import ACTIONS_A_BOOK, Vanished

PLAN_LIMIT = 30
LIMIT_S = {"small": inf, "full": 60.0}
FEW_STEPS, FEW_ROOMS = 5, 4
STEPS = {"small": (3, 4), "full": (3, 5, 10, 20, 40, 80, 160)}
ROOMS = {"small": (3, 4), "full": (3, 4, 8, 16, 32)}
BOOKS = {"small": (1,), "full": (1, 2, 3, 4)}
FIGURES = {
    "small": Path(__file__).parent / "results" / "joint_growth.png",
    "full": Path(__file__).parents[1] / "docs" / "images" / "joint_growth.png",
}


Make = Callable[[Knowledge, tuple[Literal, ...], int], Reasoner[History]]
SIDES: Mapping[str, tuple[str, Make]] = {
    "ti": ("TI: one call", JointReasoner),
    "ati_one_call": ("ATI, one call per phase", OneCallReasoner),
    "staged": ("TI, staged", StagedJointReasoner),
    "ati": ("ATI, from scratch", ReferenceReasoner),
    "kept": ("ATI, multi-shot sessions", IncrementalReasoner),
}


def main(size: str) -> list[Sheet]:
    """Sheets `history`, `rooms` and `plan`, and a figure of them. Raises DisagreementError."""
    sheets = measure(STEPS[size], ROOMS[size], BOOKS[size], LIMIT_S[size])
    draw(sheets, FIGURES[size])
    return sheets


def measure(
    steps: Sequence[int], rooms: Sequence[int], books: Sequence[int], limit_s: float = inf
) -> list[Sheet]:
    """Times after so many steps, with so many rooms, and where so many books are gone.

    A side that takes longer than `limit_s` is asked no larger question. Raises DisagreementError.
    """
    longer = {count: Vanished(count, 1, FEW_ROOMS) for count in steps}
    wider = {count: Vanished(FEW_STEPS, 1, count) for count in rooms}
    harder = {n * ACTIONS_A_BOOK: Vanished(FEW_STEPS, n, FEW_ROOMS) for n in books}
    notes = (
        "rules: of the largest program that was solved; conflicts: of all calls together;",
        f"one call: with a horizon for plans of at most {PLAN_LIMIT} actions",
    )
    asked = (
        ("history", "One book gone, after so many steps", "steps", longer),
        ("rooms", "One book gone, to one of so many rooms", "rooms", wider),
        ("plan", "More books gone: so many actions", "actions", harder),
    )
    return [
        Sheet(name, title, gathered(_rows(column, questions, limit_s)), notes)
        for name, title, column, questions in asked
    ]


def _rows(column: str, questions: Mapping[int, Vanished], limit_s: float) -> Iterator[Row]:
    given_up = set[str]()
    for value, question in questions.items():
        row: dict[str, Value] = {column: value, "explanations": question.explanations}
        for side in SIDES:
            row |= dict.fromkeys((f"{side}_ms", f"{side}_rules", f"{side}_conflicts"))
            if side in given_up:
                continue
            found = within(limit_s, lambda q=question, s=side: _asked(q, s))  # type: ignore[misc]
            row |= found or {f"{side}_ms": f"> {limit_s:.0f} s"}
            if found is None:
                given_up.add(side)
        yield {key: row[key] for key in row if not key.startswith(("kept_r", "kept_c"))}


def _asked(question: Vanished, side: str) -> dict[str, Value]:
    """One decision: its time, when whatever a robot keeps is grounded, and what was solved."""
    make = SIDES[side][1]
    reasoner = make(question.knowledge, question.goal, PLAN_LIMIT)
    if make is IncrementalReasoner:
        question.ask(reasoner)
        forget()
        reasoner = make(question.knowledge, question.goal, PLAN_LIMIT)
    with no_collection(), _watched() as controls:
        taken, _ = timed(lambda: question.ask(reasoner))
    statistics = [control.statistics for control in controls]
    return {
        f"{side}_ms": taken,
        f"{side}_rules": int(max((s["problem"]["lp"]["rules"] for s in statistics), default=0)),
        f"{side}_conflicts": int(sum(map(_conflicts, statistics))),
    }


def _conflicts(statistics: Mapping[str, Any]) -> float:
    return float(statistics["accu"]["solving"]["solvers"]["conflicts"])


@contextmanager
def _watched() -> Iterator[list[clingo.Control]]:
    """The controls of all programs that are solved from scratch meanwhile; they count conflicts."""
    controls: list[clingo.Control] = []

    def watched(
        texts: Iterable[str], constants: Mapping[str, int], facts: Iterable[Symbol]
    ) -> clingo.Control:
        control = ground(texts, constants, facts)
        settings: Any = control.configuration
        settings.stats = "1"
        controls.append(control)
        return control

    with ExitStack() as stack:
        for module in (diagnosis, reasoners, joint, one_call):
            stack.enter_context(patch.object(module, "ground", watched))
        yield controls


def draw(sheets: Sequence[Sheet], path: Path) -> None:
    """Times of each sheet over its first column, on logarithmic scales, as PNG."""
    figure = Figure(figsize=(11, 3.8), layout="constrained")
    for axes, sheet in zip(figure.subplots(1, len(sheets), sharey=True), sheets, strict=True):
        over = next(iter(sheet.rows[0]))
        for side, (label, _) in SIDES.items():
            times = [(row[over], row[f"{side}_ms"]) for row in sheet.rows]
            points = [point for point in times if isinstance(point[1], float)]
            axes.plot(*zip(*points, strict=True), marker="o", label=label)
        axes.set(xlabel=LABELS[sheet.name], yscale="log", xscale=SCALES[sheet.name])
        axes.grid(visible=True, alpha=0.3)
    figure.axes[0].set_ylabel("time of one decision (ms)")
    figure.axes[0].legend(frameon=False, fontsize="small")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)


LABELS = {"history": "steps of history", "rooms": "rooms", "plan": "actions of the shortest plan"}
SCALES = {"history": "log", "rooms": "linear", "plan": "linear"}
