"""A task without the constants that its goal does not need, in the first names of their classes.

What is true of a constant that is independent of all others (`asp.reasoning.relevance`) matters
only where it stands in the way. Without those that the goal leaves alone and that never stand in
the way, a robot decides as it does with them; tasks that differ in names alone become the same
task, and share what is prepared for it in a process.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping
from functools import lru_cache

from msgspec import structs

from agents.shared import retold, sessions_of
from asp.language import (
    Action,
    Literal,
    Signature,
    analyse,
    parse_description,
    reachable,
    restrict,
    syntax,
    text_of,
)
from asp.language import variable_sorts as roles
from asp.reasoning import Relevance, interchangeable, knowledge
from asp.solving import State, preparation
from testbed.protocol import Decision, Percept, Task

TASK_ABSTRACTION = True
"""Whether anything is left out: it pays at L8, with 24 objects, 1.5 to 2 times as long without."""

_SECTIONS: Mapping[type[syntax.Statement], str] = {
    syntax.SortDefinition: "sorts",
    syntax.Fact: "facts",
    syntax.InitiallyStatement: "initially",
    syntax.SeesStatement: "sees",
    syntax.ShowsStatement: "shows",
}
_DECLARED = {"static": "statics", "inertial": "fluents", "defined": "fluents"}
# They say nothing of the transition diagram, nor of what is seen of it.
_SILENT = (syntax.CostStatement, syntax.TriggerStatement, syntax.QuietStatement)


class AbstractTask:
    """The task that is left of another, its transitions, and the way between their names.

    Where the domain has defaults, everything is kept. `robot` is the one that plays; `fluents` are
    those about what is left, and `inertial` the inertial ones of them, in their own names.
    """

    def __init__(self, task: Task) -> None:
        domain = _domain(task.source, task.domain)
        classes = domain.classes
        kept = domain.needed(task)
        # The kept members are named as the first ones of their class, in the same order.
        pairs = (zip([m for m in each if m in kept], each, strict=False) for each in classes)
        self._there = {old: new for each in pairs for old, new in each}
        left = frozenset(self._there.values())
        members = frozenset(constant for each in classes for constant in each)
        source = _without(task.source, task.domain, members - left)
        self._gone = members - kept
        self._back = {new: old for old, new in self._there.items()}
        self.task = structs.replace(
            task, source=source, goal=self.seen(task.goal), initial=self.seen(task.initial)
        )
        with preparation():
            self._known = knowledge(task.domain, source)
        description = self._known.description
        self.robot = self._back.get(description.robots[0], description.robots[0])
        self.fluents = self.back(description.fluents)
        self.inertial = self.back(description.inertial)

    def seen(self, literals: Iterable[Literal]) -> list[Literal]:
        """Literals or actions in the names of the task that is left; the others are left out."""
        return [text.renamed(self._there) for text in literals if self.is_about(text)]

    def back(self, literals: Iterable[Literal]) -> list[Literal]:
        """Literals or actions of the task that is left, in their own names."""
        return [literal.renamed(self._back) for literal in literals]

    def is_about(self, literal: Literal) -> bool:
        """Whether a literal or action names nothing that is left out."""
        return self._gone.isdisjoint(literal.arguments)

    def after(self, state: State, action: Action | None, events: Iterable[Action]) -> State | None:
        """The next state, where the action and the events occur together; None: they cannot."""
        attempt = None if action is None else self.seen([action])[0]
        found = sessions_of(self._known).transitions.after(
            frozenset(self.seen(state)), attempt, tuple(self.seen(events))
        )
        if found is None or (action is not None and not found[1]):
            return None
        return frozenset(self.back(found[0]))

    def news(self, state: State, action: Action | None, events: Iterable[Action]) -> list[Action]:
        """Those of the events, told in this order, that can have occurred with the action.

        An event that undoes an earlier one takes its place; one that changes nothing is no event.
        """
        found: list[Literal] = []
        for event in filter(self.is_about, events):
            if self.after(state, action, [event]) is not None:
                found.append(event)
                while self.after(state, action, found) is None:
                    found.pop(0)
        return found

    def percept(self, percept: Percept) -> Percept:
        """What is told of a step, as far as it is about what is left."""
        left = structs.replace(
            percept,
            visible=[*filter(self.is_about, percept.visible)],
            doubtful=[*filter(self.is_about, percept.doubtful)],
            events=[event for event in percept.events if self.is_about(event.action)],
        )
        return retold(left, lambda literal: literal.renamed(self._there))

    def decision(self, decision: Decision) -> Decision:
        """A decision in the names of the whole task."""
        if all(old == new for old, new in self._back.items()):
            return decision
        return retold(decision, lambda literal: literal.renamed(self._back))


class _Domain:
    """What may be left out of the tasks of a domain; `classes` are interchangeable constants."""

    def __init__(self, source: str, file: str) -> None:
        description, (laws, signature) = parse_description(source, file), analyse(source, file)
        self.classes = interchangeable(laws, signature)
        self._members = frozenset(constant for each in self.classes for constant in each)
        self._inertial = description.inertial
        self._relevance = Relevance(laws, signature)
        self._whole = (
            not TASK_ABSTRACTION
            or bool(description.defaults)
            or _may_hinder(laws, signature, self._relevance.obstacles)
        )

    def needed(self, task: Task) -> frozenset[str]:
        """The members of classes that a task needs, and one of each class at least.

        A robot that heeds everything needs them all.
        """
        if self._whole or task.relevance == "all":
            return self._members
        known = frozenset(each.atom for each in task.initial)
        possible = {literal for literal in task.initial if literal.is_positive}
        possible.update(fluent for fluent in self._inertial if fluent not in known)
        spare = self._relevance.spare(possible, task.goal)
        firsts = (each[0] for each in self.classes if spare.issuperset(each))
        return (self._members - spare) | frozenset(firsts)


@lru_cache(maxsize=16)
def _domain(source: str, domain: str) -> _Domain:
    with preparation():
        return _Domain(source, f"{domain}.al")


def _may_hinder(source: syntax.Source, signature: Signature, obstacles: Collection[str]) -> bool:
    """Whether others can bring about that something stands in the way, by the names of fluents."""
    follows: dict[tuple[str, bool], set[tuple[str, bool]]] = defaultdict(set)
    for law in source.each(syntax.StateConstraint):
        for part in roles.literals(law.body):
            follows[part.atom.name, part.positive].add((law.head.atom.name, law.head.positive))
    made = (
        (law.head.atom.name, law.head.positive)
        for law in source.each(syntax.CausalLaw)
        if signature.symbols[law.action.name].kind == "exogenous"
    )
    hindering = {(name, True) for name in obstacles}
    return any(reachable(effect, follows) & hindering for effect in made)


@lru_cache(maxsize=64)
def _without(text: str, domain: str, dropped: frozenset[Literal]) -> str:
    """The AL_d text without some constants, and without what says nothing of the diagram."""
    if not dropped:
        return text
    with preparation():
        source = restrict(analyse(text, f"{domain}.al")[0], dropped)
        spoken = (s for s in source.statements if not isinstance(s, _SILENT))
        return "".join(f"{_section(s)}\n  {text_of(s)}\n" for s in spoken)


def _section(statement: syntax.Statement) -> str:
    if isinstance(statement, syntax.Declaration):
        return _DECLARED.get(statement.kind, "actions")
    return _SECTIONS.get(type(statement), "laws")
