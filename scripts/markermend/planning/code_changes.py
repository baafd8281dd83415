"""Which modules were edited since the last run, for a person who wonders why stages run again.

Reads: provenance.json of the last run, the code of the scripts.
"""

from __future__ import annotations

import json
from pathlib import Path

from markermend.planning.code_hashes import code
from markermend.storage import snakemake_records


def code_changes(project: Path, provenance: Path) -> list[str]:
    """Name the modules that were edited since the last run.

    Parameters
    ----------
    project : Path
        The folder of the Snakefile.
    provenance : Path
        The facts of the last run, if there was one.

    Returns
    -------
    list of str
        A line for each module that was edited, added or removed, with the scripts that use it.
    """
    try:
        before = json.loads(provenance.read_text(encoding="utf-8"))["code"]
    except (OSError, ValueError, KeyError, TypeError):
        return []
    users: dict[str, list[str]] = {}
    for script in sorted(before):
        file = project / "scripts" / f"{script}.py"
        changed = set(before[script]).symmetric_difference(code(file)) if file.is_file() else ()
        for module in {entry.partition(":")[0] for entry in changed}:
            users.setdefault(module, []).append(script)
    return [f"code changed since the last run: {module} (of {', '.join(users[module])})" for module in sorted(users)]


def unnoticed_changes(results: Path, provenance: Path) -> list[str]:
    """Warn where changes cannot be noticed.

    Parameters
    ----------
    results : Path
        The folder of results.
    provenance : Path
        The facts of the last run, if there was one.

    Returns
    -------
    list of str
        A line where Snakemake's records of the results are gone.
    """
    records = (results / snakemake_records.FOLDER).parent
    if not provenance.exists() or records.is_dir():
        return []
    return [
        f"the records in {records} are gone: options, code and originals that have changed since the results were "
        "made are not noticed; --forceall makes all results anew"
    ]
