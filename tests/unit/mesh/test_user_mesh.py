import json

import numpy as np
import pytest

from markermend.core.recording import BadRecording
from markermend.mesh import user_mesh
from markermend.mesh.inference import infer_mesh, infer_meshes
from markermend.options.mesh import MeshOptions
from markermend.storage import mesh_file
from support.bodies import recording, subject

OPTIONS = MeshOptions()
UPPER = {"name": "upper", "markers": ["0a", "0b", "0c", "0d", "1a", "1b"], "parent": None, "parent_marker": None}
LOWER = {"name": "lower", "markers": ["1c", "1d", "2a", "2b", "2c", "2d"], "parent": 0, "parent_marker": "1a"}


def read(path):
    """The meshes of a user's file."""
    return user_mesh.parse_file(mesh_file.read_user_file(path), path.name)


@pytest.fixture(scope="module")
def body():
    return subject(1, tree=(None, 0, 1))[:2]


@pytest.fixture
def own():
    return user_mesh.parse({"segments": [UPPER, LOWER]}, "own.json")


def test_the_supplied_mesh_wins_and_its_statistics_come_from_the_data(body, own):
    supplied = infer_mesh([recording(*body)], supplied=own, options=OPTIONS)
    inferred = infer_mesh([recording(*body)], options=OPTIONS)
    assert [(s.name, list(s.markers), s.parent) for s in supplied.segments] == [
        ("upper", UPPER["markers"], None),
        ("lower", LOWER["markers"], 0),
    ]
    assert [s.residual_mm > 5 for s in supplied.segments] == [True, True]
    assert supplied.segments[1].edge_cost > 0
    assert supplied.segments[0].parent_marker in LOWER["markers"]
    assert supplied.predictors["2a"] == (*[n for n in supplied.neighbours["2a"] if n in LOWER["markers"]], "1a")
    assert supplied.neighbours == inferred.neighbours
    assert supplied.warnings == ()


def test_it_serves_only_recordings_with_its_markers(body, own):
    names, positions = body
    mine, other = recording(names, positions, name="mine"), recording(["p", "q"], positions[:, :2], name="other")
    static = recording([*names, "medial"], np.pad(positions, ((0, 0), (0, 1), (0, 0))), name="static", kind="static")
    meshes = infer_meshes([other, static, mine], supplied=[own], options=OPTIONS)
    assert [(m.recordings, m.segments[0].name) for m in meshes] == [(("mine", "static"), "upper"), (("other",), "p+q")]
    closer = user_mesh.parse({"segments": [{**UPPER, "name": "all", "markers": names}]}, "closer.json")
    for both in ([own, closer], [closer, own]):
        assert infer_meshes([mine], supplied=both, options=OPTIONS)[0].segments[0].name == both[0].names[0]
    partial = user_mesh.parse({"segments": [{**UPPER, "name": "most", "markers": names[:-1]}]}, "partial.json")
    assert infer_meshes([mine], supplied=[partial, own], options=OPTIONS)[0].segments[0].name == "upper"


def test_markers_that_the_mesh_does_not_name_are_attached_to_the_nearest(body):
    names, positions = body
    own = user_mesh.parse({"segments": [UPPER, LOWER]}, "own.json")
    far = np.random.default_rng(1).normal(0, 3000, (len(positions), 1, 3))
    beside = positions[:, -1:] + 20.0
    more = recording([*names, "beside", "far"], np.concatenate((positions, beside, far), axis=1))
    mesh = infer_mesh([more], supplied=own, options=OPTIONS)
    extra = {s.markers: s for s in mesh.segments[2:]}
    assert extra[("beside",)].parent == 1
    assert extra[("beside",)].parent_marker == names[-1]
    assert extra[("far",)].parent is extra[("far",)].parent_marker is None
    assert (extra[("beside",)].component, extra[("far",)].component) == (0, 1)
    assert mesh.predictors["beside"][0] == names[-1]
    assert len(mesh.predictors["beside"]) == OPTIONS.min_predictors
    assert mesh.warnings == ("not named in the mesh file, attached to the nearest marker: beside, far",)


def test_markers_and_segments_that_no_recording_holds_are_left_out(body):
    gone = {"name": "gone", "markers": ["x", "y"], "parent": 0, "parent_marker": "0a"}
    lower = {**LOWER, "parent": "gone", "parent_marker": "x", "markers": [*LOWER["markers"], "z"]}
    own = user_mesh.parse({"segments": [UPPER, gone, lower]}, "own.json")
    mesh = infer_mesh([recording(*body)], supplied=own, options=OPTIONS)
    assert [(s.name, s.parent, list(s.markers)) for s in mesh.segments[1:]] == [("lower", 0, LOWER["markers"])]
    assert mesh.segments[1].parent_marker in UPPER["markers"]
    assert mesh.warnings == ("named in the mesh file, held by no recording: x, y, z",)


def test_it_is_used_where_there_are_too_few_frames_to_infer(body, own):
    names, positions = body
    mesh = infer_mesh([recording(names, positions[:10])], supplied=own, options=OPTIONS)
    assert [list(s.markers) for s in mesh.segments] == [UPPER["markers"], LOWER["markers"]]
    assert mesh.predictors["1c"] == ("1d", "2a", "2b", "2c", "2d", "1a")
    assert mesh.segments[1].edge_cost is None


def test_an_inferred_mesh_can_be_supplied_again(body, tmp_path):
    inferred = infer_mesh([recording(*body)], options=OPTIONS)
    path = tmp_path / "mesh.json"
    path.write_text(json.dumps({"meshes": [inferred.as_json()]}), encoding="utf-8")
    (own,) = read(path)
    assert infer_mesh([recording(*body)], supplied=own, options=OPTIONS) == inferred


@pytest.mark.parametrize(
    ("segments", "reason"),
    [
        ([], "list of one or more objects"),
        ("upper", "list of one or more objects"),
        ([{"name": "a"}], "segment 'a': lacks the key 'markers'"),
        ([{**UPPER, "name": 3}], "'name' must be a text"),
        ([{**UPPER, "markers": []}], "segment 'upper': 'markers' must be a list"),
        ([{**UPPER, "markers": "0a"}], "segment 'upper': 'markers' must be a list"),
        ([UPPER, {**LOWER, "name": "upper"}], "segment 'upper' is named twice"),
        ([UPPER, {**LOWER, "markers": ["0a"]}], "marker '0a' is named twice"),
        ([UPPER, {**LOWER, "parent": 2}], "parent 2 is no segment"),
        ([UPPER, {**LOWER, "parent": -1}], "parent -1 is no segment"),
        ([UPPER, {**LOWER, "parent": "trunk"}], "parent 'trunk' is no segment"),
        ([UPPER, {**LOWER, "parent": True}], "'parent' must be the index or name"),
        ([UPPER, {**LOWER, "parent_marker": "2a"}], "parent_marker '2a' is no marker of its parent"),
        ([UPPER, {**LOWER, "parent_marker": None}], "parent_marker None is no marker of its parent"),
        ([{**UPPER, "parent": 1, "parent_marker": "1c"}, LOWER], "segment 'upper': its parents form a cycle"),
        ([{**UPPER, "parent": 0, "parent_marker": "0a"}], "segment 'upper': its parents form a cycle"),
    ],
)
def test_a_malformed_mesh_is_refused_with_the_place(segments, reason, tmp_path):
    path = tmp_path / "own.json"
    path.write_text(json.dumps({"segments": segments}), encoding="utf-8")
    with pytest.raises(BadRecording, match=r"^mesh file own\.json: ") as error:
        read(path)
    assert reason in str(error.value)


@pytest.mark.parametrize("text", ["{", "[]", "3", '{"meshes": [3]}', '{"meshes": {}}', "\x00\xff"])
def test_a_file_that_is_no_mesh_is_refused(text, tmp_path):
    path = tmp_path / "own.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(BadRecording, match=r"own\.json"):
        read(path)
