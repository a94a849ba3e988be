"""A robot that finds books gone: a question whose explanations all matter to the plan."""

from dataclasses import dataclass

from agents.intentional.activities import History
from agents.shared import Reasoner
from asp.language import Action, Fluent, Literal
from asp.reasoning import Knowledge, knowledge
from asp.reasoning.diagnosis import SELECT, Explanation
from benchmarks.offices import book_names, office, room_names
from benchmarks.problems import delivered, placed
from benchmarks.sheets import DisagreementError

ACTIONS_A_BOOK = 4


@dataclass(frozen=True)
class Vanished:
    """In a hub with rooms around it the robot finds that the books are gone that it left there.

    It went to and fro for `steps` steps, and nobody knows when each of the `books` went and to
    which of the `rooms`. It wants them back. From each of the rooms that takes four actions a book,
    so that under all explanations the shortest plan is equally long.
    """

    steps: int
    books: int
    rooms: int

    @property
    def knowledge(self) -> Knowledge:
        return knowledge("office", office(self.books, self.rooms, "hub"))

    @property
    def goal(self) -> tuple[Literal, ...]:
        return delivered(book_names(self.books), room_names(self.rooms)[0])

    @property
    def explanations(self) -> int:
        """How many smallest explanations there are: for each book a step and a room."""
        return int(((self.steps - 1) * (self.rooms - 1)) ** self.books)

    def ask(self, reasoner: Reasoner[History]) -> int:
        """The length of the plan that is decided on at the last step. Raises DisagreementError."""
        history = self.history()
        plan = reasoner.intend(history, reasoner.diagnose(history, Explanation())).plan
        if len(plan) != ACTIONS_A_BOOK * self.books:
            raise DisagreementError(f"{len(plan)} actions for {self}: {type(reasoner).__name__}")
        return len(plan)

    def history(self) -> History:
        """What the robot did and saw."""
        hub, near, *_ = room_names(self.rooms)
        books = book_names(self.books)
        start, *way = ([hub, near] * self.steps)[: self.steps][::-1]
        true = placed(dict.fromkeys(books, hub), start)
        history = History()
        fluents = self.knowledge.description.fluents
        history.observe([f if f in true else f.complement for f in fluents], 0)
        history.happened(SELECT, True, 0)
        for step, room in enumerate(way, start=1):
            history.attempt(Action.of("move", ("rob1", room)), step)
            history.happened(Action.of("move", ("rob1", room)), True, step)
            history.observe([Fluent.of("loc", ("rob1", room))], step + 1)
        history.observe([Literal.of("loc", (book, hub), False) for book in books], self.steps)
        history.step = self.steps
        return history
