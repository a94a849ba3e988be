"""Mistakes in a configuration: each is one line with its place and what would be right."""

from pathlib import Path

import pytest

from testbed.cli.loading import load
from tests.config.tiny import VALID, refusal

pytestmark = pytest.mark.versions


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("seed: 3", "sed: 3", "tiny.yaml:2: sed: unknown key; did you mean 'seed'?"),
        ("goal:", "gaol:", "tiny.yaml:3: gaol: unknown key; did you mean 'goal'?"),
        ("steps: 20", "stps: 20", "tiny.yaml:11: limits.stps: unknown key; did you mean 'steps'?"),
        ("seed: 3", "seed: three", "tiny.yaml:2: seed: should be an integer, not 'three'"),
        (
            "{mode: colocated, probability: 0.5}",
            "always",
            "tiny.yaml:9: observability.exo_move: should be a mapping, not 'always'",
        ),
        (
            "scenarios: [1, random]",
            "scenarios: 5",
            "tiny.yaml:5: scenarios: should be a list such as [5]",
        ),
        (
            "colocated",
            "colocatd",
            "tiny.yaml:9: observability.exo_move.mode: should be 'never', 'colocated' or "
            "'always', not 'colocatd'; did you mean 'colocated'?",
        ),
        (
            "0.5",
            "1.5",
            "tiny.yaml:9: observability.exo_move.probability: should be less than or equal "
            "to 1, not 1.5",
        ),
        (
            "exo_move:",
            "exo_mov:",
            "tiny.yaml:9: observability.exo_mov: no such exogenous action; "
            "did you mean 'exo_move'?",
        ),
        (
            "book1,library)",
            "bok1,library)",
            "tiny.yaml:3: goal[0]: 'bok1' in loc(bok1,library) is not known there; "
            "did you mean 'book1'?",
        ),
        (
            '["loc(book1,library)"]\n',
            "[]\n",
            'tiny.yaml:3: goal: should not be empty; for example goal: ["f(a,b)", "-g(a)"]',
        ),
        (
            "loc(book1,lib",
            "lok(book1,lib",
            "tiny.yaml:3: goal[0]: no fluent 'lok'; did you mean 'locked'?",
        ),
        (
            "loc(rob1,kitchen)",
            "loc(rob1,kitchn)",
            "tiny.yaml:4: initial[0]: 'kitchn' in loc(rob1,kitchn) is not known there; "
            "did you mean 'kitchen'?",
        ),
        (
            "loc(book1,library)",
            "locked(library,kitchen)",
            "tiny.yaml:3: goal[0]: locked takes 1 arguments, as in locked(library)",
        ),
        (
            "[1, random]",
            "[1, randm]",
            "tiny.yaml:5: scenarios[1]: unknown scenario 'randm'; did you mean 'random'?",
        ),
        (
            "[1, random]",
            "[1, 1]",
            "tiny.yaml:5: scenarios[1]: '1' is listed twice; keep one of the two",
        ),
        (
            "script: []",
            'script: [{step: 1, action: "exo_move(book2,kichen)"}]',
            "tiny.yaml:7: scenario_settings.1.script[0].action: 'kichen' in "
            "exo_move(book2,kichen) is not known there; did you mean 'kitchen'?",
        ),
        (
            "script: []",
            'script: [{step: 1, action: "-exo_lock(library)"}]',
            "tiny.yaml:7: scenario_settings.1.script[0].action: -exo_lock(library) has a sign; "
            "write it as in exo_lock(library)",
        ),
        (
            "script: []",
            'script: [{step: 2, action: "exo_lock(library)"}, '
            '{step: 2, action: "exo_move(book2,kitchen)"}]',
            "tiny.yaml:7: scenario_settings.1.script[1].step: step 2 has an action already; "
            "one a step",
        ),
        (
            '"loc(book1,library)"]\ninitial',
            '"loc(book1,library)", "-loc(book1,library)"]\ninitial',
            "tiny.yaml:3: goal[1]: contradicts loc(book1,library); keep one of the two",
        ),
    ],
)
def test_a_mistake_gives_one_line_with_its_place_and_what_is_right(
    tmp_path: Path, old: str, new: str, line: str
) -> None:
    assert old in VALID
    assert refusal(tmp_path, VALID.replace(old, new, 1)) == [line]


def test_every_mistake_is_reported_at_once(tmp_path: Path) -> None:
    text = VALID.replace("book1,library", "bok1,library").replace("[1, random]", "[7]")
    lines = refusal(tmp_path, text, "robots=[intentinal]", read=load)
    places = [line.partition(":")[0] + line.partition(":")[2].partition(": ")[0] for line in lines]
    assert sorted(places) == ["command line robots[0]", "tiny.yaml3", "tiny.yaml5"]


@pytest.mark.parametrize(
    ("override", "line"),
    [
        ("limit", "command line: 'limit': an override is KEY=VALUE, e.g. limit=5"),
        ("limit=x", "command line: limit: should be an integer, not 'x'"),
        ("limit=0", "command line: limit: should be greater than or equal to 1, not 0"),
        ("seed=null", "command line: seed: should be an integer, not null"),
        ("limts.steps=2", "command line: limts: unknown key; did you mean 'limits'?"),
        ("seed.x=1", "command line: seed: should be an integer, not {'x': 1}"),
    ],
)
def test_a_wrong_override_is_said_to_be_one(tmp_path: Path, override: str, line: str) -> None:
    assert refusal(tmp_path, VALID, override) == [line]
