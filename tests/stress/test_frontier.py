"""What a search takes up next: cases take turns, of each the best episode first."""

from collections import Counter
from pathlib import Path

import pytest

from testbed.experiment.specs import TrialSpec
from testbed.stress.cases import cases_of
from testbed.stress.frontier import Frontier
from testbed.stress.units import Judged
from tests.stress.domains import DOMAINS, search_in

SCORES = ([0.5, 0.9, 0.1, 0.9], [3.0, 1.0, 2.0, 4.0], [0.0])


def _judged(score: float, chance: float | None = None) -> Judged:
    return Judged((), 1, score, chance, ())


@pytest.fixture(params=DOMAINS)
def cases(request: pytest.FixtureRequest, tmp_path: Path) -> list[TrialSpec]:
    return cases_of(search_in(tmp_path, request.param))[: len(SCORES)]


def test_cases_take_turns_each_with_its_greatest_score(cases: list[TrialSpec]) -> None:
    frontier, used = Frontier(), Counter[str]()
    for case, scores in zip(cases, SCORES, strict=True):
        for score in scores:
            frontier.push(case, _judged(score))
    left = {case.trial: [*scores] for case, scores in zip(cases, SCORES, strict=True)}
    while frontier:
        case, judged = frontier.pop()
        least = min(used[trial] for trial in left)
        heads = [max(own) for trial, own in left.items() if used[trial] == least]
        assert used[case.trial] == least
        assert judged.score == max(left[case.trial]) == max(heads)
        used[case.trial] += 1
        left[case.trial].remove(judged.score)
        left = {trial: own for trial, own in left.items() if own}
    assert not left


def test_with_probabilities_the_likeliest_of_all_cases_is_next(cases: list[TrialSpec]) -> None:
    frontier = Frontier()
    for case, scores in zip(cases, SCORES, strict=True):
        for score in scores:
            frontier.push(case, _judged(1.0, -score))
    order = [frontier.pop()[1].chance for _ in range(sum(map(len, SCORES)))]
    assert order == sorted(order, reverse=True)
    assert not frontier
