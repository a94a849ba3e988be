"""How a decision grows with history and plan: TI, ATI from scratch, and ATI on kept controls."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from agents.intentional.controller import Reasoner
from agents.intentional.joint import JointLogician
from agents.intentional.kept import KeptLogician
from agents.intentional.logician import Logician
from agents.shared.history import GOAL, Diagnosis, History
from agents.shared.knowledge import Knowledge, knowledge
from benchmarks.measuring import forget, no_collection, timed, within
from benchmarks.offices import book_names, office, room_names
from benchmarks.problems import delivered, placed
from benchmarks.sheets import DisagreementError, Row, Sheet

Make = Callable[[Knowledge, tuple[str, ...], int], Reasoner]

SIDES: Mapping[str, tuple[str, Make]] = {
    "ti_ms": ("TI: one program", JointLogician),
    "ati_ms": ("ATI, from scratch", Logician),
    "kept_ms": ("ATI, kept controls", KeptLogician),
}
GONE = 2
SHORT_HISTORY, SHORT_PLAN = 5, 3
PLAN_LIMIT = 30
LIMIT_S = 60.0
STEPS = {"small": (3, 4), "full": (3, 5, 10, 20, 40, 80, 160)}
ACTIONS = {"small": (2, 3), "full": (2, 4, 6, 8, 10, 12, 16)}
FIGURES = {
    "small": Path(__file__).parent / "results" / "joint_growth.png",
    "full": Path(__file__).parents[1] / "docs" / "images" / "joint_growth.png",
}


def main(size: str) -> list[Sheet]:
    """Sheets `history` and `plan`, and a figure of both (`FIGURES`). Raises DisagreementError."""
    sheets = measure(STEPS[size], ACTIONS[size])
    draw(sheets, FIGURES[size])
    return sheets


def measure(steps: Sequence[int], actions: Sequence[int], limit_s: float = LIMIT_S) -> list[Sheet]:
    """Times after histories of so many steps, and where shortest plans have so many actions.

    A side that takes longer than `limit_s` is asked no larger question. Raises DisagreementError.
    """
    histories = [Question(count, SHORT_PLAN, 4) for count in steps]
    plans = [Question(SHORT_HISTORY, count, max(4, *actions)) for count in actions]
    return [
        Sheet(
            "history",
            f"A decision that explains and plans ({SHORT_PLAN} actions) after so many steps",
            list(_rows("step", steps, histories, limit_s)),
        ),
        Sheet(
            "plan",
            f"A decision that explains ({SHORT_HISTORY} steps) and plans so many actions",
            list(_rows("action", actions, plans, limit_s)),
        ),
    ]


@dataclass(frozen=True)
class Question:
    """A robot with book1 in its hand walks to and fro, until it finds that other books are gone.

    Where they are now and when they went nobody knows: for each of them there are about as many
    smallest explanations as there are steps times rooms, and all of them can be combined. The
    shortest plan to deliver book1 has `actions` actions under all of them.
    """

    steps: int
    actions: int
    rooms: int

    def ask(self, make: Make) -> int:
        """A robot's decision at the last step; returns the length of the plan."""
        source = office(1 + GONE, self.rooms)
        target = room_names(self.rooms)[self.actions - 1]
        reasoner = make(knowledge("office", source), delivered(["book1"], target), PLAN_LIMIT)
        history = self._history()
        intention = reasoner.intend(history, reasoner.diagnose(history, Diagnosis()))
        return len(intention.plan)

    def _history(self) -> History:
        first, near, far, *_ = room_names(self.rooms)
        way = [first, *([near, far] * self.steps)][: self.steps][::-1]
        fluents = knowledge("office", office(1 + GONE, self.rooms)).description.fluents
        carried, *others = book_names(1 + GONE)
        where = {carried: way[0], **dict.fromkeys(others, first)}
        true = placed(where, way[0], f"in_hand(rob1,{carried})")
        history = History()
        history.observe([f if f in true else f"-{f}" for f in fluents], 0)
        history.happened(f"select({GOAL})", True, 0)
        for step, room in enumerate(way[1:], start=1):
            history.attempt(f"move(rob1,{room})", step)
            history.happened(f"move(rob1,{room})", True, step)
            history.observe([f"loc(rob1,{room})"], step + 1)
        history.observe([f"-loc({book},{first})" for book in others], self.steps)
        history.step = self.steps
        return history


def _rows(
    name: str, values: Sequence[int], questions: Sequence[Question], limit_s: float
) -> Iterator[Row]:
    given_up = set[str]()
    for value, question in zip(values, questions, strict=True):
        row: dict[str, int | float | str | None] = {f"{name}s": value}
        for side, (_, make) in SIDES.items():
            if side in given_up:
                row[side] = None
                continue
            answer = within(limit_s, lambda q=question, m=make: _timed(q, m))  # type: ignore[misc]
            row[side] = answer[0] if answer else f"> {limit_s:.0f} s"
            if answer is None:
                given_up.add(side)
            elif answer[1] != question.actions:
                raise DisagreementError(f"{side}: {answer[1]} actions for {question}")
        yield row


def _timed(question: Question, make: Make) -> tuple[float, int]:
    """The second time, when whatever a robot keeps is grounded, but no answer remembered."""
    if make is KeptLogician:
        question.ask(make)
    forget()
    with no_collection():
        return timed(lambda: question.ask(make))


def draw(sheets: Sequence[Sheet], path: Path) -> None:
    """Times of each sheet over its first column, on logarithmic scales, as PNG."""
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    for axes, sheet in zip(figure.subplots(1, len(sheets), sharey=True), sheets, strict=True):
        over = next(iter(sheet.rows[0]))
        for side, (label, _) in SIDES.items():
            points = [(row[over], row[side]) for row in sheet.rows if isinstance(row[side], float)]
            axes.plot(*zip(*points, strict=True), marker="o", label=label)
        axes.set(xlabel=LABELS[sheet.name], yscale="log", xscale=SCALES[sheet.name])
        axes.grid(visible=True, alpha=0.3)
    figure.axes[0].set_ylabel("time of one decision (ms)")
    figure.axes[0].legend(frameon=False)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)


LABELS = {"history": "steps of history", "plan": "actions of the shortest plan"}
SCALES = {"history": "log", "plan": "linear"}
