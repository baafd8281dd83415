"""What is true of one run and of no result: versions, commit, configuration and times."""

from __future__ import annotations

import platform
import subprocess
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from markermend import __version__
from markermend.planning.code_hashes import code
from markermend.storage.installation import package_version

PACKAGES = ("numpy", "scipy", "pyarrow", "jinja2", "plotly", "snakemake")
"""The third-party packages that results may depend on."""


def run_facts(project: Path, *, config: Mapping[str, Any], recordings: int, started: datetime) -> dict[str, Any]:
    """Collect what is true of one run and of no result.

    The results hold no clock and no machine, so that they can be compared; these facts are kept separately.

    Parameters
    ----------
    project : Path
        The folder of the Snakefile.
    config : mapping of str to Any
        The config.
    recordings : int
        Number of recordings.
    started : datetime
        When the run began, with its time zone.

    Returns
    -------
    dict
        Versions, commit, hashes of the code, configuration and times, for JSON.
    """
    return {
        "markermend": __version__,
        "commit": commit(project),
        "code": {file.stem: code(file) for file in sorted((project / "scripts").glob("*.py"))},
        "python": platform.python_version(),
        "platform": platform.platform(),
        "packages": {name: package_version(name) for name in PACKAGES},
        "config": dict(config),
        "recordings": recordings,
        "started": started.isoformat(timespec="seconds"),
        "finished": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def commit(project: Path) -> str | None:
    """Name the commit of a checkout.

    Parameters
    ----------
    project : Path
        Its folder.

    Returns
    -------
    str or None
        The full hash, with `-modified` where files differ from it; None for a folder that is no checkout.
    """
    try:
        done = subprocess.run(
            ["git", "-C", str(project), "describe", "--always", "--abbrev=40", "--exclude=*", "--dirty=-modified"],
            capture_output=True,
            text=True,
            check=True,
        )
    except (OSError, subprocess.CalledProcessError):
        return None
    return done.stdout.strip()
