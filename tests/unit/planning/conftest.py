"""What tests of planning share: the config as shipped."""

import pytest
import yaml

from support.paths import PROJECT


@pytest.fixture
def config():
    """The config with every default, as Snakemake reads it."""
    return yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))
