"""A robot that goes and looks at what it only assumes before it finishes.

Where explanations are equally small a goal may hold by assumption alone, and finishing would be a
guess. This robot pursues a stronger goal: that its goal holds, and that it is sure of it. It is
sure of a literal that it has seen to be true, or was told of at the start, for as long as it
believes that it has not changed since. Being sure is a fluent of the robot's own, with state
constraints that follow from the domain's `sees` statements; diagnosis and planning are ATI's.
"""

from collections.abc import Iterable, Iterator
from itertools import chain, count, product

from msgspec import structs

from agents.intentional.controller import IntentionalRobot
from agents.shared import Thought
from asp.language import Description, Fluent, Literal, Literals
from asp.reasoning import knowledge
from asp.solving import deciding
from testbed.protocol import Task, Trace


class CheckingRobot(IntentionalRobot):
    """Plays the task of being sure (`to_be_sure`)."""

    def begin(self, task: Task) -> None:
        """Takes the task on, with what the robot has to be sure of added to its goal."""
        with deciding():
            self._fluents = frozenset(knowledge(task.domain, task.source).description.fluents)
            super().begin(to_be_sure(task))

    def _trace(self, thought: Thought) -> Trace:
        trace = super()._trace(thought)
        # What it is sure of is no fluent of the domain.
        belief = [fluent for fluent in trace.belief if fluent in self._fluents]
        return structs.replace(trace, belief=belief)


def to_be_sure(task: Task) -> Task:
    """The task of achieving the goal and being sure of it.

    A literal that no `sees` statement ever shows cannot be checked, and is left as it is.
    """
    description = knowledge(task.domain, task.source).description
    prefixes = (f"{'very_' * n}sure_" for n in count())
    prefix = next(each for each in prefixes if each not in task.source)
    names, laws = dict[Literal, Fluent](), list[str]()
    for number, literal in enumerate(dict.fromkeys(task.goal), start=1):
        views = list(_views(description, literal))
        if views:
            name = names[literal] = Fluent.of(f"{prefix}{number}")
            laws += (f"{name} if {', '.join(view)}." for view in views)
            laws.append(f"{name.complement} if {literal.complement}.")
    if not names:
        return task
    fluents = [f"inertial {name}." for name in names.values()]
    known = frozenset(task.initial)
    sure = [name for literal, name in names.items() if literal in known]
    unsure = [name.complement for literal, name in names.items() if literal.complement in known]
    return structs.replace(
        task,
        source="\n".join([task.source, "fluents", *fluents, "laws", *laws, ""]),
        goal=[*task.goal, *names.values()],
        initial=[*task.initial, *sure, *unsure],
    )


def _views(description: Description, literal: Literal) -> Iterator[Iterable[Literal]]:
    """Conditions under which the robot sees that a literal is true.

    It sees the literal itself, or all conditions of a state constraint from which it follows: a
    book that is seen in one room is seen not to be in another.
    """
    for condition in _sights(description, literal):
        yield dict.fromkeys((literal, *condition))
    for law in description.constraints:
        if law.head == literal and law.body:
            for conditions in product(*(_sights(description, part) for part in law.body)):
                yield dict.fromkeys(chain(law.body, *conditions))


def _sights(description: Description, literal: Literal) -> list[Literals]:
    """Conditions under which the robot sees whether a literal is true."""
    robot = description.robots[0]
    return [
        statement.body
        for statement in description.sees
        if (statement.robot, statement.fluent) == (robot, literal.atom)
    ]
