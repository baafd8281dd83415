"""The default options of the project, and where it and the data of the benchmarks lie."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from markermend.options.config import read_config

PROJECT = Path(__file__).resolve().parents[2]
"""The folder of the project."""

DATA = PROJECT.parent / "shared/data"
"""The folder of recordings, unless the command line names another."""

OPTIONS: dict[str, Any] = read_config({})
"""The default options of each section of the config."""
