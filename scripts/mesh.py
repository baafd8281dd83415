"""Infer the functional body mesh of a subject: rigid segments of markers, and which markers predict which.

Reads: 01_markers.parquet of all the subject's recordings, mesh files of the user.
Writes: mesh.json.
"""

from collections.abc import Sequence
from functools import partial
from typing import Any

from markermend.command.inputs import undamaged
from markermend.command.recordings import read_subject
from markermend.command.stage import Stage
from markermend.mesh import inference, user_mesh
from markermend.options.mesh import MeshOptions
from markermend.storage import mesh_file

STAGE = Stage("mesh", __doc__, MeshOptions)
STAGE.reads("markers", "trajectories as ingested, of every recording of the subject", many=True, lenient=True)
STAGE.reads("mesh_files", "meshes of the user, which win over inferred ones", many=True, optional=True)
STAGE.writes("mesh", "meshes")


def work(call: Any) -> str:
    markers = undamaged(call.markers, call.facts["inputs"]["markers"], output=call.mesh, stage="mesh")
    recordings = read_subject(markers, prepare=partial(inference.prepare, options=call.options))
    files = [(mesh_file.read_user_file(path), path.name) for path in call.mesh_files]
    supplied = [own for content, name in files for own in user_mesh.parse_file(content, name)]
    meshes = inference.infer_meshes(recordings, supplied=supplied, options=call.options)
    call.facts["inputs"]["markers"] = sorted(filter(None, call.facts["inputs"]["markers"]))
    mesh_file.write(call.mesh, meshes, call.facts)
    little = (
        f"; too little motion: {', '.join(lacks)}" if (lacks := [text for own in meshes for text in own.lacks]) else ""
    )
    return "; ".join(f"{len(m.segments)} segments of {len(m.markers)} markers" for m in meshes) + little


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
