import importlib
import itertools
import json
import shlex
from dataclasses import replace

import numpy as np
import pytest

from markermend.core import mesh
from markermend.core.recording import BadRecording, SetAside
from markermend.mesh.inference import infer_mesh
from markermend.options.flags import write_flags
from markermend.options.mesh import MeshOptions
from markermend.storage import mesh_file, stage_files
from support.bodies import recording, subject


@pytest.fixture(scope="module")
def body():
    return subject(1, tree=(None, 0, 1))[:2]


@pytest.fixture(scope="module")
def pooled(body):
    names, positions = body
    recordings = [
        recording(names, positions, name="all"),
        recording(names[:-2], positions[:, :-2], name="fewer"),
    ]
    return infer_mesh(recordings, options=MeshOptions())


@pytest.fixture
def run(tmp_path):
    """Run the mesh stage on named recordings, in the given order; returns what it wrote."""
    flags = shlex.split(write_flags(MeshOptions()))

    def run_stage(recordings, *files):
        paths = []
        for name, one in recordings.items():
            paths.append(tmp_path / name / "01_markers.parquet")
            if isinstance(one, str):
                stage_files.set_aside(paths[-1], "ingest", one)
            else:
                stage_files.write_recording(paths[-1], one, {"stage": "ingest"})
        out = tmp_path / "mesh.json"
        own = ["--mesh-files", *map(str, files)]
        importlib.import_module("mesh").main(["--markers", *map(str, paths), *own, "--mesh", str(out), *flags])
        return out

    return run_stage


def test_json_and_back(pooled, tmp_path):
    mesh_file.write(tmp_path / "mesh.json", [pooled], {"stage": "mesh"})
    assert mesh.from_json(stage_files.read_json(tmp_path / "mesh.json")["meshes"][0]) == pooled
    assert mesh_file.read(tmp_path / "mesh.json", "all") == pooled
    with pytest.raises(BadRecording, match="'other'"):
        mesh_file.read(tmp_path / "mesh.json", "other")


def test_a_recording_sees_no_marker_that_it_does_not_hold(body, pooled):
    names, _ = body
    gone = set(names[-2:])
    mine = mesh_file.for_recording({"meshes": [json.loads(json.dumps(pooled.as_json()))]}, "fewer")
    assert set(mine.markers) == set(mine.predictors) == set(mine.neighbours) == set(names) - gone
    listed = itertools.chain(*mine.predictors.values(), *mine.neighbours.values(), *(s.markers for s in mine.segments))
    assert not gone & set(listed)
    assert not gone & {s.parent_marker for s in mine.segments}
    assert [s.parent for s in mine.segments] == [s.parent for s in pooled.segments]
    for marker, names_left in mine.predictors.items():
        assert len(names_left) == len(pooled.predictors[marker])
        assert len(set(names_left)) == len(names_left)
        assert marker not in names_left


def test_a_recording_that_no_mesh_was_inferred_from_has_the_one_of_its_markers(body, pooled):
    names, _ = body
    value = {"meshes": [json.loads(json.dumps(replace(pooled, markers=("p1", "p2")).as_json())), pooled.as_json()]}
    same = mesh_file.for_recording(value, "other", names)
    assert replace(same, absent={}) == replace(pooled, absent={})
    mine = mesh_file.for_recording(value, "other", [*names[1:], "new"])
    fewer = pooled.without({names[0]})
    assert mine.markers == tuple(sorted([*names[1:], "new"]))
    assert mine.predictors == {**fewer.predictors, "new": ()} and mine.neighbours == {**fewer.neighbours, "new": ()}
    assert mine.segments == fewer.segments
    assert mine.warnings == ("the recordings that the mesh was inferred from lack new",)
    assert np.isnan(mine.shape(mine.markers).distance[mine.markers.index("new")]).sum() == len(names) - 1
    with pytest.raises(BadRecording, match="'other'"):
        mesh_file.for_recording(value, "other", ["q"])


def test_the_stage_pools_a_subject_and_does_not_depend_on_order(body, run):
    names, positions = body
    whole = {
        "b": recording(names, positions[:800], name="b"),
        "a": recording(names[1:], positions[800:, 1:], name="a"),
        "bad": "no 3-D data",
        "prop": recording(["p1", "p2"], positions[:, :2], name="prop"),
    }
    one = run(whole).read_bytes()
    other = run(dict(reversed(whole.items()))).read_bytes()
    assert one == other
    value = json.loads(one)
    assert [entry["recordings"] for entry in value["meshes"]] == [["a", "b"], ["prop"]]
    assert len(mesh_file.for_recording(value, "b").segments) == 3
    assert names[0] not in mesh_file.for_recording(value, "a").markers
    with pytest.raises(BadRecording):
        mesh_file.for_recording(value, "bad")


def test_the_stage_names_recordings_by_their_folder_if_need_be(body, run):
    names, positions = body
    nameless = recording(names, positions)
    nameless.facts.clear()
    assert stage_files.read_json(run({"folder": nameless}))["meshes"][0]["recordings"] == ["folder"]


def test_the_stage_passes_on_that_all_were_set_aside(run):
    with pytest.raises(SetAside, match="no 3-D data") as note:
        stage_files.read_json(run({"a": "no 3-D data", "b": "no 3-D data"}))
    assert note.value.stage == "ingest"


def test_the_stage_takes_the_users_mesh_and_says_what_is_wrong_with_it(body, run, tmp_path):
    names, positions = body
    own = tmp_path / "own.json"
    segment = {"name": "everything", "markers": names, "parent": None, "parent_marker": None}
    own.write_text(json.dumps({"segments": [segment]}), encoding="utf-8")
    found = mesh_file.read(run({"a": recording(names, positions, name="a")}, own), "a")
    assert [s.name for s in found.segments] == ["everything"]
    own.write_text(json.dumps({"segments": [{**segment, "parent": 7}]}), encoding="utf-8")
    with pytest.raises(SetAside, match=r"own\.json: segment 'everything': parent 7"):
        stage_files.read_json(run({"a": recording(names, positions, name="a")}, own))


def test_no_value_in_the_file_is_missing(body):
    names, positions = body
    lonely = recording([*names, "never"], np.pad(positions, ((0, 0), (0, 1), (0, 0)), constant_values=np.nan))
    value = infer_mesh([lonely], options=MeshOptions()).as_json()
    json.dumps(value, allow_nan=False)
    assert value["predictors"]["never"] == ()


def test_neighbours_as_places_in_a_recording(body, pooled):
    names = body[0][::-1]
    for marker, near in zip(names, pooled.neighbour_indices(names), strict=True):
        assert tuple(names[place] for place in near) == pooled.neighbours[marker]
    for marker, near in zip(names, pooled.segment_mate_indices(names), strict=True):
        assert tuple(names[place] for place in near) == pooled.predictors[marker]
