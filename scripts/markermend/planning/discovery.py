"""What a config names, found on disk: recordings, the meshes that users supply, and people's decisions.

Reads: the recordings' folder or table, the table of decisions.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from typing import Any

from markermend.options.general import GeneralOptions
from markermend.planning import config as planning_config
from markermend.planning import decision_table, recording_table, recordings
from markermend.planning.recordings import BadDataSet, Entry, NoRecordings

Folders = tuple[str, str]
"""Names of the folders of a subject and a recording."""


def find_recordings(general: GeneralOptions, results: str) -> tuple[dict[Folders, Entry], list[str]]:
    """Find the recordings below a folder or in a table.

    Parameters
    ----------
    general : GeneralOptions
        Folder or table as the config has it, which links are followed, and which folders are days.
    results : str
        Absolute path of the folder of results, which holds no recordings.

    Returns
    -------
    entries : dict of (str, str) to Entry
        The recordings by the names of their folders.
    warnings : list of str
        What was left out, and why.

    Raises
    ------
    NoRecordings
        Where there is no such folder or table.
    BadDataSet
        Where it cannot be used.
    """
    path = os.path.abspath(os.path.expanduser(general.recordings))
    warnings: list[str] = []
    if os.path.isdir(path):
        found, warnings = recordings.find(
            path, results, follow_links=general.follow_links, day_folders=general.day_folders
        )
    elif path.lower().endswith((".c3d", ".trc")) and os.path.isfile(path):
        raise BadDataSet(f"recordings: {path} is a recording itself: name the folder that holds it, or a table")
    elif os.path.isfile(path):
        found = recording_table.read(path)
    else:
        asked = "which recordings? There is" if general.recordings == GeneralOptions().recordings else "there is"
        raise NoRecordings(
            f"recordings: {asked} no such folder or table: {path}. Name the folder of your recordings, or a table of them: --config "
            "recordings=FOLDER results=FOLDER"
        )
    return {entry.folders: entry for entry in found}, warnings


def find_decisions(
    options: Mapping[str, Any], entries: Sequence[Entry]
) -> tuple[dict[Folders, list[dict[str, Any]]], list[str]]:
    """Find what people decided; a table that the user named must be there, the one of the default need not.

    Parameters
    ----------
    options : mapping of str to Any
        The options of each section of the config.
    entries : sequence of Entry
        The recordings.

    Returns
    -------
    decisions : dict of (str, str) to list of dict
        The decisions on each recording, by the names of its folders.
    warnings : list of str
        Warnings for the user of lines without effect.

    Raises
    ------
    BadDataSet
        Where the table cannot be used.
    """
    path = _decision_table(options)
    return decision_table.load(path, entries, planning_config.methods(options)) if path else ({}, [])


def standard_decisions(options: Mapping[str, Any]) -> str:
    """Write the table of decisions for the report.

    Parameters
    ----------
    options : mapping of str to Any
        The options of each section of the config; the table is one that `find_decisions` understands.

    Returns
    -------
    str
        See decision_table.standard_form; the names of the columns alone where there is no table.
    """
    path = _decision_table(options)
    return decision_table.standard_form(path, planning_config.methods(options)) if path else decision_table.NONE


def _decision_table(options: Mapping[str, Any]) -> str | None:
    """Path of the table of decisions; None where there is none."""
    name: str | None = options["general"].decisions
    if name is None or (name == GeneralOptions().decisions and not os.path.exists(name)):
        return None
    return os.path.abspath(os.path.expanduser(name))


def supplied_meshes(entries: Mapping[Folders, Entry], files: Sequence[str]) -> dict[str, list[str]]:
    """List the mesh files that users supply for each subject.

    Parameters
    ----------
    entries : mapping of Folders to Entry
        The recordings, by the names of their folders.
    files : sequence of str
        Mesh files for all subjects of which the table of recordings names none.

    Returns
    -------
    dict of str to list of str
        Absolute paths in alphabetical order, or in the order of `files`, by the name of the subject's folder.

    Raises
    ------
    BadDataSet
        Where Snakemake cannot take a file as an input.
    """
    own: dict[str, set[str]] = {}
    for (subject, _), entry in entries.items():
        own.setdefault(subject, set()).update([entry.mesh] if entry.mesh is not None else [])
    shared = [os.path.abspath(path) for path in files]
    meshes = {subject: sorted(paths) or shared for subject, paths in own.items()}
    for path in dict.fromkeys(path for paths in meshes.values() for path in paths):
        if not nameable(path):
            raise BadDataSet(f"mesh file {path} is not there, or its name is none that Snakemake can take: rename it")
    return meshes


def nameable(path: str) -> bool:
    """Whether Snakemake can take a file as an input.

    Parameters
    ----------
    path : str
        Path of the file.

    Returns
    -------
    bool
        True where the file exists and its path is UTF-8 without wildcards and angle brackets.
    """
    plain = not re.search(r"\{.*\}|[<>]", path, re.DOTALL)
    return plain and path == path.encode(errors="replace").decode() and os.path.exists(path)
