"""mesh.json: the meshes of a subject on disk."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from markermend.core.mesh import Mesh, from_json
from markermend.core.recording import BadRecording
from markermend.storage import atomic, stage_files


def for_recording(value: dict[str, Any], name: str) -> Mesh:
    """Pick from the content of mesh.json the mesh of a recording, less the markers that the recording does not hold.

    Raises BadRecording where the file has no mesh for it.
    """
    for entry in value["meshes"]:
        if name in entry["recordings"]:
            mesh = from_json(entry)
            return mesh.without(mesh.absent.get(name, ()))
    raise BadRecording(f"no mesh for recording {name!r} in mesh.json: run the mesh stage again with its markers")


def read(path: Path, name: str) -> Mesh:
    """Read from mesh.json the mesh of a recording; raises SetAside where the mesh stage set the subject aside."""
    return for_recording(stage_files.read_json(path), name)


def write(path: Path, meshes: Sequence[Mesh], facts: dict[str, Any]) -> None:
    """Write meshes, in the order of their recordings, as mesh.json."""
    ordered = sorted(meshes, key=lambda mesh: mesh.recordings)
    atomic.write_json(path, {"meshes": [mesh.as_json() for mesh in ordered], "facts": facts})
