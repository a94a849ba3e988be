"""Configurations: YAML with dotted overrides in, a validated `ExperimentConfig` out."""

from testbed.config.errors import ConfigError
from testbed.config.loading import load_config
from testbed.config.models import ExperimentConfig

__all__ = ["ConfigError", "ExperimentConfig", "load_config"]
