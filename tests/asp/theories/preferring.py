"""The preferred answer sets of stories: the order of declaration comes in as ranks."""

from collections.abc import Sequence

import clingo
from clingo import Symbol

from asp import load_description
from asp.solving import fact, ground
from tests.asp.reasoning.stories import lines, theories_for
from tests.asp.theories.axioms import domain_text, theory_text


def ranks(domain: str) -> list[Symbol]:
    """rank(A,R) for the agent's and for the exogenous actions, and ranks(M)."""
    description = load_description(domain)
    kinds = (description.agent_actions, description.exogenous_actions)
    places = [fact("rank", action, n) for actions in kinds for n, action in enumerate(actions)]
    return [fact("ranks", max(map(len, kinds))), *places]


def ground_story(
    domain: str,
    theory: str,
    rules: Sequence[str],
    constants: dict[str, int],
    ranked: Sequence[Symbol] | None = None,
) -> clingo.Control:
    """The ground program of a story; `ranked` stands in for the domain's own ranks."""
    theories = map(theory_text, theories_for(theory))
    texts = [domain_text(domain), *theories, lines(*rules)]
    return ground(texts, constants, ranks(domain) if ranked is None else ranked)
