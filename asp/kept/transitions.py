"""What an action leads to."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from clingo import Symbol

from asp.kept.control import KeptControl, State
from asp.solving import fact, solving


class Transitions:
    """The transition diagram of a domain, one transition at a time."""

    def __init__(self, program: str, fluents: Sequence[str], ranks: Iterable[Symbol]) -> None:
        self._kept = KeptControl(program, "kept_transition", fluents, ranks, n=1)

    def after(
        self, state: State, attempt: str | None, reported: tuple[str, ...]
    ) -> tuple[State, bool] | None:
        """The next state, and whether the attempt took effect; None where nothing fits.

        `attempt` is the agent's action, or None; `reported` are exogenous actions that happened.
        """
        kept = self._kept
        actions = [fact("reported", event) for event in reported]
        if attempt is not None:
            actions.append(fact("attempted", attempt))
        kept.switch_on(*actions)
        assumptions = kept.assume_state(state, 0)
        if assumptions is None:
            return None
        happened = None if attempt is None else kept.literal("occurs", attempt, 0)
        with solving(kept.control, assumptions) as model:
            if model is None:
                return None
            return kept.state(model, 1), happened is not None and model.is_true(happened)
