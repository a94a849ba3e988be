"""The input of a reasoner: a description, its program, the order of its actions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from hashlib import blake2b

from clingo import Symbol

from asp.language import Action, Description, Literal, parse_description
from asp.reasoning.determinism import deterministic_by_form
from asp.reasoning.qualifications import qualifications
from asp.solving import LimitError, State, fact
from asp.translation import translate

# A robot whose domain follows from its goal has as many domains as goals.
_REMEMBERED = 32

Goal = tuple[Literal, ...]
"""Literals that are to hold together."""


def satisfied(goal: Goal, state: State) -> bool:
    """Whether a state satisfies a goal."""
    return all((each.atom in state) == each.is_positive for each in goal)


@dataclass(frozen=True)
class Knowledge:
    """A domain as reasoning uses it.

    `program` is the translation of its description, with rules that say where an action has no
    successor though no law forbids it.
    """

    description: Description
    program: str

    @staticmethod
    def of(description: Description, translation: str) -> Knowledge:
        """The knowledge of a description and its translation.

        Where there are too many conditions of actions without a successor it has some of them.
        """
        rules: list[str] = []
        with suppress(LimitError):
            rules.extend(each.rule for each in qualifications(description, translation))
        more = ["", "% What no state can follow, though no law says so.", *rules] if rules else []
        return Knowledge(description, "\n".join([translation, *more]))

    @cached_property
    def ranks(self) -> tuple[Symbol, ...]:
        """rank(A,R): the place of each action in its order, from 0; ranks(M)."""
        kinds = self.description.agent_actions, self.description.exogenous_actions
        places = (fact("rank", a, place) for actions in kinds for place, a in enumerate(actions))
        return fact("ranks", max(map(len, kinds))), *places

    @cached_property
    def start(self) -> tuple[Symbol, ...]:
        """fluent_rank(F,R) of inertial fluents, default_rank(D,R), initially(N,F)."""
        known = self.description
        return (
            *(fact("fluent_rank", fluent, n) for n, fluent in enumerate(known.inertial)),
            *(fact("default_rank", default.name, n) for n, default in enumerate(known.defaults)),
            *(fact("initially", n, f) for n, some in enumerate(known.initially) for f in some),
        )

    @cached_property
    def actions(self) -> tuple[frozenset[Action], frozenset[Action]]:
        """The agent's own actions, and exogenous ones."""
        description = self.description
        return frozenset(description.agent_actions), frozenset(description.exogenous_actions)

    @cached_property
    def deterministic(self) -> bool:
        """Whether it is known that every action has one outcome."""
        return deterministic_by_form(self.description)

    def against(self, exceptions: Iterable[str]) -> list[Literal]:
        """The literals that hold at step 0 where these defaults, given by name, have exceptions."""
        names = frozenset(exceptions)
        heads = (d.head for d in self.description.defaults if d.name in names)
        return list(dict.fromkeys(each.complement for each in heads))


@lru_cache(maxsize=_REMEMBERED)
def knowledge(name: str, source: str, ties: int | None = None) -> Knowledge:
    """The knowledge that an AL_d text holds. Raises asp.SourceError.

    With `ties` the order of its exogenous actions is drawn, with this number as seed: of equally
    small explanations another one is then the first. That of some of the actions does not depend on
    the others.
    """
    description = parse_description(source, f"{name}.al")
    known = Knowledge.of(description, translate(source, f"{name}.al"))
    if ties is None:
        return known
    drawn = sorted(description.exogenous_actions, key=lambda action: _drawn(ties, action))
    return replace(known, description=replace(description, exogenous_actions=tuple(drawn)))


def _drawn(seed: int, action: Action) -> bytes:
    return blake2b(f"{seed} {action}".encode()).digest()


def goal_facts(goal: Iterable[Literal]) -> Iterator[Symbol]:
    """goal(F,B) for each literal of the goal."""
    for literal in goal:
        yield fact("goal", literal.atom, "true" if literal.is_positive else "false")
