"""What the rules leave to the adversary: of its budget, its cooldown, and its events."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

from asp.language import Action, Description
from testbed.environment.rules import EventRules, Situation


@dataclass(frozen=True)
class Left:
    """What is left to the adversary at a step.

    `budget`: events, None where there is no bound; `cooldown`: steps until it may act again;
    `per_object`: by sort and object, events that may still name the object.
    """

    budget: int | None = None
    cooldown: int = 0
    per_object: Mapping[str, Mapping[str, int]] = field(default_factory=dict)


UNBOUNDED = Left()


class Allowance:
    """Says what is left at a step, and which events are refused for it.

    `highest` are the largest values of the `entries`, whose smallest is 0; there may be none.
    Raises ValueError for a sort, or an event, that the description does not have.
    """

    def __init__(self, rules: EventRules, description: Description) -> None:
        self.rules = rules
        for sort in rules.per_object:
            if sort not in description.sorts:
                raise ValueError(f"per_object: {sort} is not a sort of the domain")
        known = description.exogenous_actions
        for own in rules.events or ():
            if own not in known and all(own != event.name for event in known):
                raise ValueError(f"events: {own} is not an exogenous action of the domain")
        self._objects = {sort: description.sorts[sort] for sort in rules.per_object}
        per_object = (rules.per_object[sort] for sort, own in self._objects.items() for _ in own)
        self.highest = (*self._own(rules.budget, rules.cooldown), *per_object)

    def entries(self, left: Left) -> tuple[int, ...]:
        """What is left, as numbers: of what is bounded budget, cooldown, and each object's."""
        per_object = (number for own in left.per_object.values() for number in own.values())
        return (*self._own(left.budget, left.cooldown), *per_object)

    def _own(self, budget: int | None, cooldown: int) -> tuple[int, ...]:
        cooldowns = (cooldown,) if self.rules.cooldown else ()
        return cooldowns if budget is None else (budget, *cooldowns)

    def left(self, now: Situation) -> Left:
        """What is left in a situation."""
        if not self.highest:
            return UNBOUNDED
        budget, pause, played = self.rules.budget, self.rules.cooldown, now.played
        named = Counter(own for _, event in played for own in set(event.arguments))
        return Left(
            budget=None if budget is None else max(0, budget - len(played)),
            cooldown=max(0, played[-1][0] + pause + 1 - now.step) if played else 0,
            per_object={
                sort: {own: max(0, self.rules.per_object[sort] - named[own]) for own in objects}
                for sort, objects in self._objects.items()
            },
        )

    def why_not(self, event: Action, left: Left, step: int) -> str | None:
        """One line that says why the rules refuse an event at a step; None if they do not."""
        if not self.rules.permits(event):
            return f"{event} is not one of the adversary's events (adversary.events)"
        if left.budget == 0:
            return f"the budget of {self.rules.budget} is used up (adversary.budget)"
        if left.cooldown:
            return f"cooldown until step {step + left.cooldown} (adversary.cooldown)"
        used_up = (
            f"{own} was named {self.rules.per_object[sort]} times, as often as a {sort} may be "
            f"(adversary.per_object.{sort})"
            for sort, numbers in left.per_object.items()
            for own in dict.fromkeys(event.arguments)
            if numbers.get(own, 1) == 0
        )
        return next(used_up, None)
