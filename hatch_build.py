"""Builds the package: its description, and the workflow in the wheel (Snakefile, rules, scripts, config, environments and profiles, as they lie here)."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

FOLDER = "markermend/installed_workflow"

RELATIVE = re.compile(r"\[([^\]]+)\]\((?!\w+:|#)[^)]+\)")
"""A link to another file of the project."""


class DescriptionHook(MetadataHookInterface):
    """Gives the package the README as its description."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Put the text in, with the names of other files where it links to them: they do not lie beside a description."""
        text = Path(self.root, "README.md").read_text(encoding="utf-8")
        metadata["readme"] = {"content-type": "text/markdown", "text": RELATIVE.sub(r"\1", text)}


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
