"""Where the workflow lies: in the checkout, or in the installed package."""

from __future__ import annotations

from pathlib import Path

import markermend


def workflow_folder() -> Path:
    """Find the folder of the Snakefile.

    Returns
    -------
    Path
        The workflow within the installed package, else the checkout that the package lies in.
    """
    package = Path(markermend.__file__).resolve().parent
    installed = package / "installed_workflow"
    return installed if installed.is_dir() else package.parents[1]
