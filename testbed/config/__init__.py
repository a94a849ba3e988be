"""Configurations: YAML with dotted overrides in, a validated `ExperimentConfig` out."""

from testbed.config.composing import write_yaml as write_yaml
from testbed.config.conditions import conditions_of as conditions_of
from testbed.config.conditions import with_sweep as with_sweep
from testbed.config.levels import SCENARIO_KEYS as SCENARIO_KEYS
from testbed.config.levels import level_size as level_size
from testbed.config.levels import refinement_of_files as refinement_of_files
from testbed.config.levels import refinement_of_size as refinement_of_size
from testbed.config.levels import refinements as refinements
from testbed.config.loading import config_names as config_names
from testbed.config.loading import find_config as find_config
from testbed.config.loading import lists_keys as lists_keys
from testbed.config.loading import load_config as load_config
from testbed.config.loading import validated as validated
from testbed.config.models import TRIGGERS as TRIGGERS
from testbed.config.models import ExperimentConfig as ExperimentConfig
from testbed.config.places import ConfigError as ConfigError
from testbed.config.places import Finding as Finding
from testbed.config.places import Key as Key
from testbed.config.places import Places as Places
from testbed.config.places import dotted as dotted
from testbed.config.scenarios import early_script_findings as early_script_findings
from testbed.config.sections import AdversarySettings as AdversarySettings
from testbed.config.sections import Limits as Limits
from testbed.config.sections import Observability as Observability
from testbed.config.sections import ScenarioSettings as ScenarioSettings
from testbed.config.sections import ScriptEntry as ScriptEntry
