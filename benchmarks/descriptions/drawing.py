"""Random descriptions, small enough that all their states and transitions can be listed.

Now and then one is outside of the language, and has to be refused.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from random import Random

from benchmarks.descriptions.journeys import JOURNEY
from benchmarks.descriptions.signatures import ROBOT, ROBOTS, random_signature
from benchmarks.descriptions.text import EQUAL, Atom, Description, Statement, Symbol

_FLUENTS = ("inertial", "defined")
_ANYTHING = (*_FLUENTS, *_FLUENTS, "inertial", "static")
_VARIABLES = ("X", "Y", "Z")
_SLIP = 0.01
"""The probability of a mistake where a term or a head is drawn."""


def random_description(random: Random) -> Description:
    """One of many; the same for the same state of the generator."""
    signature = random_signature(random)
    return signature.saying(_Drawing(signature, random).statements())


def random_goal(description: Description, random: Random) -> tuple[str, ...]:
    """One literal, two or three."""
    fluents = [*description.atoms("inertial"), *description.atoms("defined")]
    chosen = random.sample(fluents, min(len(fluents), random.choice([1, 1, 2, 3])))
    return tuple(random.choice(["", "", "-"]) + fluent for fluent in chosen)


@dataclass
class _Drawing:
    """Statements about symbols; each statement has variables of its own.

    What those of a journey do is said already.
    """

    signature: Description
    random: Random
    used: dict[str, frozenset[str]] = field(default_factory=dict)

    def statements(self) -> Iterator[Statement]:
        yield from self._about_statics()
        for action in self._new("agent", "exogenous"):
            heads = self._atom(action), self._effect()
            yield self._statement("causes", heads, 0, 0, 0, 1)
            if self._chance(0.3):
                yield Statement("impossible", heads[:1], heads[1:])
            yield from self._conditions(action)
        for fluent in self._new("inertial"):
            for positive in (True, False):
                if self._chance(0.6):
                    heads = self._atom(self._actor(fluent)), self._atom(fluent)
                    heads = heads[0], heads[1]._replace(positive=positive)
                    yield self._statement("causes", heads, 0, 0, 1)
        for fluent in self._of("defined"):
            for _ in range(self._number(1, 1, 2)):
                yield self._statement("law", (self._atom(fluent),), 1, 1, 2)
        for _ in range(self._number(0, 1, 2)):
            yield from self._constraints()
        yield from self._about_the_start()
        yield from self._about_sight()

    def _about_statics(self) -> Iterator[Statement]:
        for static in self._new("static"):
            for _ in range(self._number(1, 2)):
                yield self._statement("fact", (self._atom(static),), 0)
            if len(set(static.sorts)) < len(static.sorts) and self._chance(0.5):
                there, back = (Atom(static.name, each) for each in (("X", "Y"), ("Y", "X")))
                yield Statement("law", (there,), (back,))
            elif self._chance(0.2):
                head = self._atom(static)
                yield self._statement("law", (head,), 1, kinds=("static",))

    def _actor(self, fluent: Symbol) -> Symbol:
        """An action, of some the one that has most of the fluent's sorts."""
        some = [self._one_of("agent", "agent", "exogenous") for _ in range(3)]
        return max(some, key=lambda action: len({*action.sorts} & {*fluent.sorts}))

    def _conditions(self, action: Symbol) -> Iterator[Statement]:
        """What makes an action impossible, by itself or beside another one."""
        for _ in range(self._number(0, 0, 1)):
            yield self._statement("impossible", (self._atom(action),), 1, 1, 2)
        if action.kind == "agent" and self._chance(0.5):
            head, needed = self._atom(action), self._atom(self._one_of("inertial"))
            self.used.clear()
            yield Statement("impossible", (head,), (needed._replace(positive=False),))
        if self._chance(0.15):
            other = self.random.choice([*self._of("agent"), *self._of("exogenous")])
            yield self._statement("impossible", (self._atom(action), self._atom(other)), 0, 1)

    def _constraints(self) -> Iterator[Statement]:
        """A constraint, or several that go together."""
        some = [self._one, self._one, self._functional, self._cycle, *[self._rivals] * 3]
        yield from self.random.choice(some)()

    def _one(self) -> Iterator[Statement]:
        yield self._statement("law", (self._effect(),), 1, 1, 2)

    def _functional(self) -> Iterator[Statement]:
        """A thing is at one place at most."""
        for symbol in self._of("inertial"):
            if symbol.sorts:
                kept = tuple("XU"[: len(symbol.sorts) - 1])
                here, there = (Atom(symbol.name, (*kept, last)) for last in ("Y", "Z"))
                unequal = Atom(EQUAL, ("Y", "Z"), positive=False)
                yield Statement("law", (here._replace(positive=False),), (there, unequal))
                return

    def _cycle(self) -> Iterator[Statement]:
        """Two literals, each of which follows from the other."""
        one, other = self._effect(), self._effect()
        self.used.clear()
        yield Statement("law", (one,), (other,))
        yield Statement("law", (other,), (one,))

    def _rivals(self) -> Iterator[Statement]:
        """Two fluents exclude each other where a third one holds: which of them stays is open."""
        symbols = [*self._of("inertial")]
        one, other, third = map(self._atom, self.random.sample([*symbols, *symbols[-1:] * 2], 3))
        action = self._atom(self._one_of("agent", "exogenous"))
        yield self._statement("causes", (action, third), 0)
        yield Statement("law", (one._replace(positive=False),), (other, third))
        yield Statement("law", (other._replace(positive=False),), (one, third))

    def _about_the_start(self) -> Iterator[Statement]:
        for symbol in self._new("inertial"):
            if symbol.sorts and self._chance(0.2):
                terms = tuple(_VARIABLES[: len(symbol.sorts)])
                yield Statement("some", (Atom(symbol.name, terms),), name=terms[-1])
        for name in ("usual", "likely")[: self._number(0, 1, 2)]:
            head, variables = self._effect(), dict(self.used)
            yield self._statement("default", (head,), 0, 0, 1, name=name)
            if self._chance(0.4):
                self.used.update(variables)
                yield self._statement("exception", (), 1, 1, 2, name=name)

    def _about_sight(self) -> Iterator[Statement]:
        drawn = [self._one_of(*_FLUENTS) for _ in range(self._number(0, 1, 2))]
        for symbol in (*drawn, *(each for each in self._of("inertial") if self._chance(0.5))):
            atom = self._atom(symbol)
            if self._chance(0.5):
                yield self._statement("sees", (atom,), 0, 0, 1, name=ROBOT)
            else:
                seen = self._statement("sees", (atom,), 0, 1, name="R")
                yield Statement("sees", seen.heads, (Atom(ROBOTS, ("R",)), *seen.body), "R")
        for _ in range(self._number(0, 1, 2)):
            heads = self._atom(self._one_of("agent")), self._atom(self._one_of(*_FLUENTS))
            yield self._statement("shows", heads, 0, 0, 1)

    def _statement(
        self,
        kind: str,
        heads: tuple[Atom, ...],
        *sizes: int,
        name: str = "",
        kinds: Sequence[str] = _ANYTHING,
    ) -> Statement:
        """A statement with heads that have just been drawn, and a body of one of the sizes."""
        body = tuple(self._condition(kinds) for _ in range(self._number(*sizes)))
        self.used.clear()
        return Statement(kind, heads, body, name)

    def _condition(self, kinds: Sequence[str]) -> Atom:
        """A literal, a comparison of variables, or a sort that one of them is of."""
        variables = [*self.used]
        if len(variables) > 1 and self._chance(0.15):
            return Atom(EQUAL, (variables[0], variables[-1]), self._chance(0.3))
        if variables and self._chance(0.1):
            members = self.used[variables[0]]
            fitting = [s for s in self.signature.sorts if members & {*self.signature.members(s)}]
            self.used[variables[0]] &= {
                *self.signature.members(sort := self.random.choice(fitting))
            }
            return Atom(sort, (variables[0],))
        return self._signed(self._atom(self._one_of(*kinds)))

    def _effect(self) -> Atom:
        """A literal of an inertial fluent; by mistake also of another kind."""
        kind = self.random.choice(["defined", "static"]) if self._chance(_SLIP) else "inertial"
        return self._signed(self._atom(self._one_of(kind)))

    def _signed(self, atom: Atom) -> Atom:
        return atom._replace(positive=self._chance(0.6))

    def _one_of(self, *kinds: str) -> Symbol:
        """A symbol of one of the kinds; of an inertial fluent where there is none."""
        symbols = [*self._of(self.random.choice(kinds))] or [*self._of("inertial")]
        return self.random.choice(symbols)

    def _atom(self, symbol: Symbol) -> Atom:
        return Atom(symbol.name, tuple(map(self._term, symbol.sorts)))

    def _term(self, sort: str) -> str:
        """A variable that is in use, a new one, or a constant; by mistake one of another sort."""
        members = self.signature.members(sort)
        fitting = [v for v, others in self.used.items() if others & {*members}]
        if fitting and self._chance(0.85):
            chosen = self.random.choice(fitting)
        elif len(self.used) < len(_VARIABLES) and self._chance(0.7):
            chosen = _VARIABLES[len(self.used)]
        else:
            some = sort if not self._chance(_SLIP) else self.random.choice([*self.signature.sorts])
            return self.random.choice(self.signature.members(some))
        self.used[chosen] = self.used.get(chosen, frozenset(members)) & {*members}
        return chosen

    def _of(self, kind: str) -> Iterator[Symbol]:
        return (symbol for symbol in self.signature.symbols if symbol.kind == kind)

    def _new(self, *kinds: str) -> Iterator[Symbol]:
        every = (symbol for kind in kinds for symbol in self._of(kind))
        return (symbol for symbol in every if symbol.name not in JOURNEY)

    def _number(self, *choices: int) -> int:
        return self.random.choice(choices)

    def _chance(self, probability: float) -> bool:
        return self.random.random() < probability
