"""Configurations: YAML with dotted overrides in, a validated `ExperimentConfig` out."""

from testbed.config.composing import write_yaml
from testbed.config.levels import (
    SCENARIO_KEYS,
    level_size,
    refinement_of_files,
    refinement_of_size,
    refinements,
)
from testbed.config.loading import config_names, find_config, lists_keys, load_config
from testbed.config.models import (
    TRIGGERS,
    AdversarySettings,
    ExperimentConfig,
    Limits,
    Observability,
    ScenarioSettings,
    ScriptEntry,
)
from testbed.config.places import ConfigError, Finding, dotted
from testbed.config.scenarios import early_script_findings

__all__ = [
    "SCENARIO_KEYS",
    "TRIGGERS",
    "AdversarySettings",
    "ConfigError",
    "ExperimentConfig",
    "Finding",
    "Limits",
    "Observability",
    "ScenarioSettings",
    "ScriptEntry",
    "config_names",
    "dotted",
    "early_script_findings",
    "find_config",
    "level_size",
    "lists_keys",
    "load_config",
    "refinement_of_files",
    "refinement_of_size",
    "refinements",
    "write_yaml",
]
