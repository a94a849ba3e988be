"""How a decision grows: with the history, the length of the plan, the books, the rooms."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from agents.intentional.activities import History
from agents.intentional.reasoners import IncrementalReasoner, ReferenceReasoner
from agents.shared import Intention, Reasoner
from asp.language import Action, Fluent, Literal
from asp.reasoning import Knowledge, knowledge
from asp.reasoning.diagnosis import SELECT, Explanation
from benchmarks.measuring import forget, median, no_collection, timed, within
from benchmarks.offices import book_names, office, room_names
from benchmarks.problems import Problem, delivered, drawn, placed
from benchmarks.sheets import DisagreementError, Row, Sheet, Value, gathered
from benchmarks.sieges import Question, Siege, besiege

Make = Callable[[Knowledge, tuple[Literal, ...], int], Reasoner[History]]

PLAN_LIMIT = 30
LIMIT_S = {"small": inf, "full": 20.0}
FAST_SHARE = 2  # all problems of a point, of which the reference has one
STEPS = {"small": (3, 6), "full": (5, 10, 20, 50, 100, 200, 500, 1000)}
WINDOW = {"small": 4, "full": 40}
BOOKS = {"small": (2, 3), "full": (2, 4, 8, 16)}
ROOMS = {"small": (4,), "full": (4, 8, 16, 32)}
CARRIED = {"small": (1,), "full": (1, 2, 3, 4, 5)}
CORRIDORS = {"small": (4,), "full": (4, 8, 12, 16, 20)}
DRAWN = {"small": 2, "full": 6}
LIVES = {"small": 1, "full": 5}


def main(size: str) -> list[Sheet]:
    """Sheets `books`, `rooms`, `carrying`, `corridor`, `largest` and `history`.

    Raises DisagreementError.
    """
    number = DRAWN[size]
    note = (
        "first: the first problem of a process, with all grounding; fast: other problems after it;",
        f"reference: on the last of these problems, given up after {LIMIT_S[size]:.0f} s",
    )
    families: dict[str, tuple[str, Iterator[tuple[Value, list[Problem]]]]] = {
        "books": (
            "The first decision, 4 rooms in a row, 2 books wanted of so many",
            ((n, list(drawn(n, 4, "row", 2, 1, number))) for n in BOOKS[size]),
        ),
        "rooms": (
            "The first decision, 2 books wanted of 2, so many rooms in a grid",
            ((n, list(drawn(2, n, "grid", 2, 1, number))) for n in ROOMS[size]),
        ),
        "carrying": (
            "The first decision, all of so many books are carried through 4 rooms in a row",
            ((n, list(_carrying(n, 4))) for n in CARRIED[size]),
        ),
        "corridor": (
            "The first decision, one book is carried through so many rooms in a row",
            ((n, list(_carrying(1, n))) for n in CORRIDORS[size]),
        ),
    }
    if size == "full":
        largest = list(drawn(16, 32, "grid", 3, 1, 4))
        title = "The first decision, 3 books wanted of 16, 32 rooms in a grid"
        families["largest"] = (title, iter([("16 books, 32 rooms", largest)]))
    sheets = [
        Sheet(name, title, gathered(_family(name, points, LIMIT_S[size])), note)
        for name, (title, points) in families.items()
    ]
    return [*sheets, _history(size)]  # last, for it grounds an office in this very process


def _carrying(books: int, rooms: int) -> Iterator[Problem]:
    """The books from the first room to the last; where the robot starts varies."""
    names = room_names(rooms)
    where = dict.fromkeys(book_names(books), names[0])
    for robot in ("kitchen", names[0], "library"):
        yield Problem(
            f"{books} books through {rooms} rooms",
            office(books, rooms),
            placed(where, robot),
            delivered(book_names(books)),
        )


@dataclass(frozen=True)
class _Point:
    """Times (ms) of the fast side on the problems of a point, and its plans."""

    first_ms: float
    took_ms: list[float]
    plans: list[tuple[Action, ...]]


def _family(
    name: str, points: Iterator[tuple[Value, list[Problem]]], limit_s: float
) -> Iterator[Row]:
    slow_before = fast_before = False
    for value, problems in points:
        fast = None if fast_before else within(limit_s * FAST_SHARE, lambda p=problems: _fast(p))  # type: ignore[misc]
        slow = None if slow_before else within(limit_s, lambda p=problems: _slow(p[-1]))  # type: ignore[misc]
        fast_before, slow_before = fast is None, slow is None
        if fast is not None and slow is not None and fast.plans[-1] != slow[1]:
            raise DisagreementError(f"{name} {value}: {fast.plans[-1]} and {slow[1]}")
        yield {
            name: value,
            "longest_plan": max(map(len, fast.plans)) if fast else None,
            "first_ms": fast.first_ms if fast else f"> {limit_s * FAST_SHARE:.0f} s",
            "fast_median_ms": median(fast.took_ms) if fast else None,
            "fast_worst_ms": max(fast.took_ms) if fast else None,
            "reference_ms": slow[0] if slow else f"> {limit_s:.0f} s",
            "times_faster": _ratio(
                slow[0] if slow else None, fast.took_ms[-1] if fast else None, limit_s
            ),
            "agree": True if fast and slow else None,
        }


def _ratio(slow: float | None, fast: float | None, limit_s: float) -> Value:
    if fast is None:
        return None
    return f"> {limit_s * 1e3 / fast:,.0f}" if slow is None else slow / fast


def _fast(problems: Sequence[Problem]) -> _Point:
    """All problems but the last half are played before those that are measured."""
    half = len(problems) // 2
    warm, measured = problems[:half], problems[half:]
    first, _ = timed(lambda: [first_decision(p, IncrementalReasoner) for p in warm[:1]])
    for problem in (*warm[1:], *(replace(p, initial=_moved(p)) for p in measured)):
        first_decision(problem, IncrementalReasoner)
    took, plans = [], []
    for problem in measured:
        forget()
        with no_collection():
            ms, intention = timed(lambda p=problem: first_decision(p, IncrementalReasoner))  # type: ignore[misc]
        took.append(ms)
        plans.append(intention.plan)
    return _Point(first, took, plans)


def _moved(problem: Problem) -> tuple[Fluent, ...]:
    """Another problem of about the same length: the library's lock is the other way round."""
    lock = Fluent.of("locked", ("library",))
    return tuple({*problem.initial} ^ {lock})


def _slow(problem: Problem) -> tuple[float, tuple[Action, ...]]:
    took, intention = timed(lambda: first_decision(problem, ReferenceReasoner))
    return took, intention.plan


def first_decision(problem: Problem, make: Make) -> Intention:
    """What a robot intends at step 1, which has seen nothing that it did not know."""
    fluents = problem.description.fluents
    history = History(step=1)
    history.observe([f if f in problem.state else f.complement for f in fluents], 0)
    history.happened(SELECT, True, 0)
    reasoner = make(problem.knowledge, problem.goal, problem.limit)
    return reasoner.intend(history, reasoner.diagnose(history, Explanation()))


def _history(size: str) -> Sheet:
    notes = (
        "2 books, 4 rooms; an event undoes part of the goal in each step that would achieve it;",
        "ordinary: the robot is told; contradiction: once, after the given step, it is not told;",
        "answers are forgotten before each measured decision",
    )
    rows = gathered(_lives(STEPS[size], WINDOW[size], LIVES[size], LIMIT_S[size]))
    return Sheet("history", "A decision after a history of so many steps", rows, notes)


def _lives(steps: Sequence[int], window: int, number: int, limit_s: float) -> Iterator[Row]:
    source = office()
    initial = placed({"book1": "kitchen", "book2": "office1"}, "kitchen")
    goal = delivered(book_names(2))
    given_up: dict[str, bool] = {}
    for step in steps:
        sieges = _long_lives(source, initial, goal, step, window, number)
        for kind, (took, question) in _points(sieges, step).items():
            slow = None if given_up.get(kind) else _asked_again(source, goal, question, limit_s)
            given_up[kind] = slow is None
            yield {
                "step": step,
                "decision": kind,
                "measured": len(took),
                "fast_median_ms": median(took),
                "fast_worst_ms": max(took),
                "reference_ms": slow if slow is not None else f"> {limit_s:.0f} s",
                "times_faster": _ratio(slow, median(took), limit_s),
                "agree": None if slow is None else True,
            }


def _long_lives(
    source: str,
    initial: Sequence[Literal],
    goal: Sequence[Literal],
    step: int,
    window: int,
    number: int,
) -> list[Siege]:
    """Lives up to a contradiction after `step`, when all they need has been grounded before."""
    last = step + number + 25
    window_steps = range(max(1, step - window), last)
    lives = []
    for late in (0, *range(number)):
        forget()
        with no_collection():
            life = besiege(
                source,
                initial,
                goal,
                last,
                silent=[step + late],
                forgetful=window_steps,
                recorded=window_steps,
            )
        lives.append(life)
    return lives[1:]


def _points(sieges: Sequence[Siege], step: int) -> Mapping[str, tuple[list[float], Question]]:
    """Of each kind of decision: the times in the windows, and one question."""
    ordinary, contradictions = list[float](), list[float]()
    for siege in sieges:
        steps = sorted(siege.questions)
        news = next(i for i in steps if i > step and siege.contradicted(i - 1))
        ordinary += (siege.took_ms[i - 1] for i in steps if i < news)
        contradictions.append(siege.took_ms[news - 1])
        before = siege.questions[max(i for i in steps if i < news)]
        question = siege.questions[news]
    return {"ordinary": (ordinary, before), "contradiction": (contradictions, question)}


def _asked_again(
    source: str, goal: tuple[Literal, ...], question: Question, limit_s: float
) -> float | None:
    """How long the reference takes with a question (ms). Raises DisagreementError."""

    def ask() -> tuple[float, bool]:
        reference = ReferenceReasoner(knowledge("office", source), goal, PLAN_LIMIT)
        history = question.history
        diagnosis_ms, explained = timed(lambda: reference.diagnose(history, question.adopted))
        planning_ms, intention = timed(lambda: reference.intend(history, explained))
        agree = explained.explanation == question.explained.explanation
        return diagnosis_ms + planning_ms, agree and intention == question.intention

    answer = within(limit_s, ask)
    if answer is not None and not answer[1]:
        raise DisagreementError(f"at step {question.history.step}")
    return None if answer is None else answer[0]
