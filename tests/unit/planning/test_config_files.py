"""The generated files are current."""

import pytest

from markermend.planning import config_files
from support.paths import PROJECT


@pytest.mark.parametrize("path", config_files.generate(PROJECT), ids=lambda path: path.name)
def test_made_files_are_current(path):
    assert path.read_text(encoding="utf-8") == config_files.generate(PROJECT)[path], "run: make config"
