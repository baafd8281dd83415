"""The file mesh.json, the meshes of a subject, and the mesh files of users."""

from __future__ import annotations

import json
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from markermend.core.mesh import Mesh, from_json
from markermend.core.recording import BadRecording
from markermend.storage import atomic, stage_files


def for_recording(value: dict[str, Any], name: str, markers: Collection[str] = ()) -> Mesh:
    """Pick the mesh of a recording: the one that was inferred from it, else the one that shares most markers with it.

    Parameters
    ----------
    value : dict
        The content of mesh.json.
    name : str
        Name of the recording.
    markers : collection of str, optional
        Markers of the recording. Without them only a mesh that was inferred from it is picked.

    Returns
    -------
    Mesh
        The mesh without the markers that the recording does not hold.

    Raises
    ------
    BadRecording
        Where the file has no mesh for the recording.
    """
    for entry in value["meshes"]:
        if name in entry["recordings"]:
            mesh = from_json(entry)
            return mesh.without(mesh.absent.get(name, ()))
    shared = [len({*markers} & {*entry["markers"]}) for entry in value["meshes"]]
    if any(shared):
        return from_json(value["meshes"][shared.index(max(shared))]).fitted(markers)
    raise BadRecording(f"no mesh for recording {name!r} in mesh.json: run the mesh stage again with its markers")


def read(path: Path, name: str, markers: Collection[str] = ()) -> Mesh:
    """Read the mesh of a recording; see `for_recording`.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        Name of the recording.
    markers : collection of str, optional
        Markers of the recording.

    Returns
    -------
    Mesh
        The mesh without the markers that the recording does not hold.

    Raises
    ------
    SetAside
        Where the mesh stage set the subject aside.
    """
    return for_recording(stage_files.read_json(path), name, markers)


def read_groups(path: Path) -> list[tuple[str, ...]]:
    """Read which recordings share a mesh.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    list of tuple of str
        Names of the recordings of each mesh.

    Raises
    ------
    SetAside
        Where the mesh stage set the subject aside.
    """
    return [tuple(entry["recordings"]) for entry in stage_files.read_json(path)["meshes"]]


def write(path: Path, meshes: Sequence[Mesh], facts: dict[str, Any]) -> None:
    """Write meshes in the order of their recordings.

    Parameters
    ----------
    path : Path
        The file.
    meshes : sequence of Mesh
        The meshes of a subject.
    facts : dict
        What the stage says of itself, JSON values.
    """
    ordered = sorted(meshes, key=lambda mesh: mesh.recordings)
    atomic.write_json(path, {"meshes": [mesh.as_json() for mesh in ordered], "facts": facts})


def read_user_file(path: Path) -> Any:
    """Read a mesh file that a user wrote.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Any
        Its JSON value, not checked.

    Raises
    ------
    BadRecording
        Where it is no JSON file.
    """
    try:
        return json.loads(path.read_text(encoding="utf-8-sig"))
    except (ValueError, OSError) as error:
        raise BadRecording(f"mesh file {path.name}: {error}: give a JSON file") from error
