"""The files that detectors read."""

import shlex
from dataclasses import replace
from types import SimpleNamespace

import pytest

import mesh as mesh_script
from markermend.options.flags import write_flags
from markermend.options.mesh import MeshOptions
from markermend.storage import stage_files


@pytest.fixture(scope="session")
def walker_files(tmp_path_factory, walker):
    """The walker's recording with one peak, and its mesh: `recording`, and the paths `markers` and `mesh`."""
    folder = tmp_path_factory.mktemp("walker")
    positions = walker.recording.positions.copy()
    positions[400, 7] += 60
    recording = replace(
        walker.recording, positions=positions, facts={"recording": "walk", "subject": "S", "kind": "dynamic"}
    )
    made = SimpleNamespace(recording=recording, markers=folder / "01_markers.parquet", mesh=folder / "mesh.json")
    stage_files.write_recording(made.markers, recording, {})
    words = shlex.split(write_flags(MeshOptions()))
    mesh_script.main(["--markers", str(made.markers), "--mesh-files", "--mesh", str(made.mesh), *words])
    return made
