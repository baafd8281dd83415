"""What is installed: where the workflow lies, in the checkout or in the package, and the versions of packages."""

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


def package_version(package: str) -> str | None:
    """Look up the version of an installed package.

    Parameters
    ----------
    package : str
        Its name.

    Returns
    -------
    str or None
        None where it is not installed in the environment of this process.
    """
    from importlib import metadata  # 0.03 s to import, which not every stage needs

    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None
