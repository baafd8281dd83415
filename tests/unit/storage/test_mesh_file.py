"""Mesh files: read as they were written, one mesh for each recording; a user's file is JSON or refused."""

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.mesh.inference import infer_mesh
from markermend.options.mesh import MeshOptions
from markermend.storage import mesh_file
from support.bodies import recording, subject


def test_a_mesh_is_read_as_it_was_written(tmp_path):
    names, positions, _ = subject(1, tree=(None, 0), frames=300)
    mesh = infer_mesh([recording(names, positions, name="walk")], options=MeshOptions())
    mesh_file.write(tmp_path / "mesh.json", [mesh], {"stage": "mesh"})
    assert mesh_file.read(tmp_path / "mesh.json", "walk") == mesh
    with pytest.raises(BadRecording, match="no mesh for recording 'run'"):
        mesh_file.read(tmp_path / "mesh.json", "run")


def test_markers_that_a_recording_lacks_are_left_out(tmp_path):
    names, positions, _ = subject(1, tree=(None, 0), frames=300)
    both = [recording(names, positions, name="a"), recording(names[1:], positions[:, 1:], name="b")]
    mesh_file.write(tmp_path / "mesh.json", [infer_mesh(both, options=MeshOptions())], {})
    assert mesh_file.read(tmp_path / "mesh.json", "b").markers == tuple(names[1:])
    assert np.array_equal(mesh_file.read(tmp_path / "mesh.json", "a").markers, names)


@pytest.mark.parametrize("content", [b"{", b"\x00\xff", None])
def test_what_is_no_json_file_is_refused(content, tmp_path):
    path = tmp_path / "own.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(BadRecording, match=r"^mesh file own\.json: .*: give a JSON file$"):
        mesh_file.read_user_file(path)


def test_a_user_file_may_begin_with_a_byte_order_mark(tmp_path):
    (tmp_path / "own.json").write_bytes(b'\xef\xbb\xbf{"segments": []}')
    assert mesh_file.read_user_file(tmp_path / "own.json") == {"segments": []}
