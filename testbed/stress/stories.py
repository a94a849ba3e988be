"""Write what a search found: a configuration per story, which replays it, and tests of them."""

import re
from collections.abc import Collection, Iterator, Mapping
from itertools import chain, count
from math import exp
from pathlib import Path
from textwrap import wrap

from testbed.config import ExperimentConfig, load_config
from testbed.experiment.episodes import Player
from testbed.experiment.plan import plan_trials
from testbed.experiment.provenance import modules_of
from testbed.experiment.run_folder import portable_text, replace_text
from testbed.experiment.storyteller import Moment
from testbed.protocol import FINISH
from testbed.registry import search_last
from testbed.stress.cases import configuration_of
from testbed.stress.catalogue import Kind
from testbed.stress.objectives import judged
from testbed.stress.shrinking import Shrunk
from testbed.stress.verdicts import Finding
from testbed.text import columns, counted

PREFIX, TESTS, STORIES = "story-", "test_stories.py", "stories.txt"
MOST_OF_NAME = 120
TEST = '''"""Stories in which a stress search found something: each fails as long as that is so."""

from pathlib import Path

import pytest

from testbed.stress import findings

STORIES = sorted(Path(__file__).parent.glob("story-*.yaml"))


@pytest.mark.parametrize("story", STORIES, ids=[path.stem for path in STORIES])
def test_nothing_is_found(story: Path) -> None:
    assert findings(story) == []
'''


def findings(config: str | Path) -> list[Finding]:
    """What the objectives of a configuration (`stress.objectives`) find in each of its trials.

    The trials are played in this process. Raises ConfigError.
    """
    folder = Path(config).resolve().parent
    search_last(modules_of(folder) or folder)
    loaded = load_config(config)
    found: list[Finding] = []
    for spec in plan_trials(loaded):
        episode = Player(spec).episode(spec.setting.script or ())
        found += judged(episode, loaded.stress).findings
    return found


def write_stories(
    folder: Path, config: ExperimentConfig, stories: Mapping[Kind, Shrunk]
) -> dict[Kind, Path]:
    """Write a configuration per story into a folder, and tests of all; their paths.

    Stories that an earlier part of the search wrote are gone then. Raises OSError.
    """
    for earlier in earlier_stories(folder):
        (folder / earlier).unlink(missing_ok=True)
    paths: dict[Kind, Path] = {}
    for kind, story in stories.items():
        path = _unused(folder, kind, paths.values())
        own = configuration_of(config, story.spec, path.stem)
        replace_text(path, f"# {kind}\n# {story.finding.detail}\n{portable_text(own, folder)}")
        paths[kind] = path
    if paths:
        replace_text(folder / TESTS, TEST)
    replace_text(folder / STORIES, "".join(f"{own.name}\n" for own in paths.values()))
    return paths


def earlier_stories(folder: Path) -> list[str]:
    """The names of the stories that a search wrote into its folder, by its list of them."""
    listed = folder / STORIES
    names = listed.read_text(encoding="utf-8").splitlines() if listed.is_file() else []
    return [name for name in names if re.fullmatch(rf"{PREFIX}[A-Za-z0-9-]+\.yaml", name)]


def _unused(folder: Path, kind: Kind, used: Collection[Path]) -> Path:
    parts = (kind.robot, kind.objective, kind.rule, *kind.events)
    name = PREFIX + re.sub(r"[^A-Za-z0-9]+", "-", "-".join(parts)).strip("-")[:MOST_OF_NAME]
    numbered = (folder / f"{name}-{number}.yaml" for number in count(2))
    return next(path for path in chain([folder / f"{name}.yaml"], numbered) if path not in used)


def told(kind: Kind, story: Shrunk, episodes: int) -> Iterator[str]:
    """A story in lines: where it begins, what the robot and others do, and what was found."""
    setting, episode = story.case.setting, Player(story.case).episode(story.events)
    world = episode.setup.world
    inertial = frozenset(world.description.inertial)
    start = sorted(inertial.intersection(world.true_atoms(next(episode.states))))
    yield f"{kind} ({counted(episodes, 'episode')})"
    yield from _wrapped("begins", " ".join(start))
    yield from _wrapped("goal", " ".join(sorted(setting.goal)))
    yield from (f"  {own.percept.step:<8}{_step(own)}" for own in episode.moments)
    yield from _wrapped("found", story.finding.detail)
    if not story.repeated:
        yield from _wrapped(
            "but", "not found when it was played again: the robot decides otherwise"
        )
    if story.chance is not None:
        chance = f"{exp(story.chance):.3g} where events are random, with rate {setting.rate:g}"
        yield from _wrapped("chance", chance)


def _wrapped(term: str, text: str) -> list[str]:
    return wrap(text, columns(), initial_indent=f"  {term:<8}", subsequent_indent=" " * 10)


def _step(moment: Moment) -> str:
    decision = moment.decision
    finishes = decision.action == FINISH
    answer = decision.action if finishes else decision.trace.mental or decision.action
    failed = ": did not happen" if moment.happened is False else ""
    event = f", and others {moment.event}" if moment.event is not None else ""
    return f"{answer}{failed}{event}"
