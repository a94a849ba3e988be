"""Configurations of searches in small domains that share no word with those of the package."""

from pathlib import Path

from testbed.config import ExperimentConfig, load_config
from tests.environment.coarse import FERRY
from tests.experiment.gardens import GARDEN
from tests.greenhouse import GREENHOUSE

DOMAINS = {
    "greenhouse": (GREENHOUSE, "[stands(fern,sill), stands(rose,sill)]"),
    "ferry": (FERRY, "[moored(goat,west), -aboard(skipper,goat)]"),
    "garden": (GARDEN.replace("OTHER", "rake"), "[stands(rake,south), -carries(tom,rake)]"),
}


def write_search(folder: Path, domain: str, *more: str) -> Path:
    """A configuration of two robots in one of the domains, from three initial states."""
    text, goal = DOMAINS[domain]
    (folder / f"{domain}.al").write_text(text, encoding="utf-8")
    path = folder / f"{domain}.yaml"
    lines = (
        f"name: {domain}",
        f"domain: {domain}.al",
        f"goal: {goal}",
        "scenarios: [none]",
        "robots: [traditional, intentional]",
        "limit: 3",
        "link: inprocess",
        *more,
    )
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def search_in(folder: Path, domain: str, *overrides: str) -> ExperimentConfig:
    """The same, loaded with overrides."""
    return load_config(write_search(folder, domain), overrides)
