"""Puts the workflow into the wheel: Snakefile, rules, scripts, config, environments and profiles, as they lie here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FOLDER = "markermend/installed_workflow"


class WorkflowHook(BuildHookInterface[Any]):
    """Adds the files of the workflow to those of the package."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Name the files to add; an editable installation uses the checkout."""
        if version == "editable":
            return
        root = Path(self.root)
        names = ["Snakefile", "config", "envs", "profiles", "workflow"]
        names += [path.relative_to(root).as_posix() for path in sorted(root.glob("scripts/*.py"))]
        build_data["force_include"].update({str(root / name): f"{FOLDER}/{name}" for name in names})
