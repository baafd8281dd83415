"""The default options of the project, and where it and the data of the benchmarks lie."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

PROJECT = Path(__file__).resolve().parents[2]
"""The folder of the project."""

DATA = PROJECT.parent / "shared/data"
"""The folder of recordings, unless the command line names another."""

CONFIG: dict[str, Any] = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))
"""The default configuration."""

MESH: dict[str, Any] = {key: value for key, value in CONFIG["mesh"].items() if key != "files"}
"""The options of the mesh without the users' own meshes."""
