"""Inferred meshes: exact on bodies with known segments, robust to gaps and artifacts, independent of order."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.mesh.inference import group_recordings, infer_mesh, infer_meshes
from markermend.options.mesh import MeshOptions
from support.bodies import adjusted_rand_index, labels, recording, subject

OPTIONS = MeshOptions()


@pytest.fixture(scope="module")
def chain():
    return subject(1)


@pytest.fixture(scope="module")
def chain_mesh(chain):
    return infer_mesh([recording(*chain[:2])], options=OPTIONS)


def edges(mesh):
    """The tree as pairs of marker sets."""
    parents = [(s, mesh.segments[s.parent]) for s in mesh.segments if s.parent is not None]
    return {frozenset((child.markers, parent.markers)) for child, parent in parents}


def test_a_chain_of_rigid_bodies_gives_exact_segments_and_tree(chain, chain_mesh):
    names, _, owners = chain
    assert adjusted_rand_index(labels(chain_mesh, names), owners) == 1.0
    parents = {s.markers[0][0]: s.parent for s in chain_mesh.segments}
    found = {child: None if s is None else chain_mesh.segments[s].markers[0][0] for child, s in parents.items()}
    assert found == {"0": "1", "1": "2", "2": None, "3": "2", "4": "3"}
    assert [s.residual_mm for s in chain_mesh.segments] == pytest.approx([0.0] * 5, abs=1e-6)
    assert [s.confidence for s in chain_mesh.segments] == pytest.approx([1.0] * 5, abs=1e-3)
    assert chain_mesh.warnings == ()


@pytest.mark.parametrize("seed", range(5))
def test_a_branching_body_gives_exact_segments_and_tree(seed):
    tree = (None, 0, 1, 0, 3, 0)
    names, positions, owners = subject(seed, tree=tree, frames=3000)
    mesh = infer_mesh([recording(names, positions)], options=OPTIONS)
    assert adjusted_rand_index(labels(mesh, names), owners) == 1.0
    own = {s: tuple(n for n, o in zip(names, owners, strict=True) if o == s) for s in set(owners)}
    joined = {frozenset((own[s], own[p])) for s, p in enumerate(tree) if p is not None}
    assert edges(mesh) == joined


def test_the_residual_is_the_deviation_of_a_marker_per_axis(chain):
    names, positions, _ = chain
    shaking = positions + np.random.default_rng(2).normal(0, 2, positions.shape)
    mesh = infer_mesh([recording(names, shaking)], options=OPTIONS)
    assert [s.residual_mm for s in mesh.segments] == pytest.approx([2.0] * 5, rel=0.1)


def test_children_are_attached_to_the_marker_at_their_joint(chain_mesh):
    hosts = {s.markers[0][0]: s.parent_marker for s in chain_mesh.segments}
    assert (hosts["3"], hosts["4"]) == ("2d", "3d")
    assert hosts["2"] in chain_mesh.segments[1].markers + chain_mesh.segments[2].markers


def test_predictors_are_siblings_then_the_parent_marker(chain, chain_mesh):
    for segment in chain_mesh.segments:
        for marker in segment.markers:
            chosen = chain_mesh.predictors[marker]
            assert set(chosen[:3]) == set(segment.markers) - {marker}
            assert chosen[3:] == (segment.parent_marker,)
            assert len(chain_mesh.neighbours[marker]) == len(chain[0]) - 1
            assert set(chain_mesh.neighbours[marker][:3]) == set(chosen[:3])


def test_two_subjects_and_a_prop_are_separate():
    names, positions, _ = subject(1)
    others, elsewhere, _ = subject(2, prefix="x", away=(1500.0, 800.0, 0.0))
    seconds = np.arange(1500) / 100
    ball = np.stack((2000 * np.sin(seconds), -900 + 700 * np.cos(1.3 * seconds), 1000 + 400 * np.sin(2 * seconds)), 1)
    both = np.concatenate((positions, elsewhere[::-1], ball[:, None], ball[:, None] + 40.0), axis=1)
    mesh = infer_mesh([recording([*names, *others, "ball", "ball2"], both)], options=OPTIONS)
    component = {marker: s.component for s in mesh.segments for marker in s.markers}
    assert {component[n] for n in names} | {component[n] for n in others} == {0, 1}
    assert component[names[0]] != component[others[0]]
    assert component["ball"] == component["ball2"] == 2
    assert mesh.neighbours["ball"] == mesh.predictors["ball"] == ("ball2",)
    assert set(mesh.neighbours[names[0]]) == set(names) - {names[0]}


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_marker_order_and_laboratory_axes_do_not_matter(seed):
    rng = np.random.default_rng(seed)
    names, positions, _ = subject(7, tree=(None, 0, 1), frames=400)
    positions += np.random.default_rng(1).normal(0, 1, positions.shape)
    order = rng.permutation(len(names))
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    moved = recording([names[i] for i in order], (positions @ turn + rng.uniform(-1e3, 1e3, 3))[:, order])
    plain = infer_mesh([recording(names, positions)], options=OPTIONS)
    other = infer_mesh([moved], options=OPTIONS)
    assert other.predictors == plain.predictors
    assert other.neighbours == plain.neighbours
    assert [(s.markers, s.parent, s.parent_marker) for s in other.segments] == [
        (s.markers, s.parent, s.parent_marker) for s in plain.segments
    ]


def test_a_fifth_missing_at_random_changes_little(chain, chain_mesh):
    names, positions, _ = chain
    spoilt = positions.copy()
    spoilt[np.random.default_rng(3).random(spoilt.shape[:2]) < 0.2] = np.nan
    mesh = infer_mesh([recording(names, spoilt)], options=OPTIONS)
    assert adjusted_rand_index(labels(mesh, names), labels(chain_mesh, names)) >= 0.8
    assert edges(mesh) == edges(chain_mesh)


def test_artifacts_change_little(chain, chain_mesh):
    names, positions, _ = chain
    rng = np.random.default_rng(5)
    spoilt = positions + rng.normal(0, 1, positions.shape)
    for m in range(len(names)):
        start = rng.integers(0, 1400)
        spoilt[start : start + 60, m] += rng.normal(0, 40, 3)
    assert edges(infer_mesh([recording(names, spoilt)], options=OPTIONS)) == edges(chain_mesh)


def test_a_subject_that_stands_still_is_warned_about(chain):
    names, positions, _ = chain
    still = positions[:300] * 0.02 + positions[0]
    mesh = infer_mesh([recording(names, still)], options=OPTIONS)
    assert list(mesh.lacks) == [
        "only 3.0 s of motion (10 s wanted)",
        f"only {len(mesh.segments)} segments for 20 markers (4 wanted)",
        "distances vary by only 4 mm (30 mm wanted)",
    ]
    assert mesh.warnings == ()
    assert max(s.confidence for s in mesh.segments) < 0.3


@pytest.mark.parametrize("count", [1, 2, 3])
def test_recordings_of_few_markers(chain, count):
    names, positions, _ = chain
    mesh = infer_mesh([recording(names[:count], positions[:, :count])], options=OPTIONS)
    assert [s.markers for s in mesh.segments] == [tuple(names[:count])]
    assert [set(mesh.predictors[n]) for n in names[:count]] == [set(names[:count]) - {n} for n in names[:count]]
    assert (mesh.segments[0].parent, mesh.segments[0].parent_marker) == (None, None)


def test_no_markers_at_all():
    mesh = infer_mesh([recording([], np.empty((100, 0, 3)))], options=OPTIONS)
    assert (mesh.segments, mesh.predictors) == ((), {})


@pytest.mark.parametrize("frames", [0, 1, 59])
def test_hardly_seen_markers_have_empty_lists(chain, frames):
    names, positions, _ = chain
    spoilt = positions.copy()
    spoilt[frames:, 2] = np.nan
    mesh = infer_mesh([recording(names, spoilt)], options=OPTIONS)
    assert labels(mesh, names[2:3]) == [-1]
    assert mesh.predictors[names[2]] == mesh.neighbours[names[2]] == ()
    assert all(names[2] not in near for near in (*mesh.predictors.values(), *mesh.neighbours.values()))


def test_a_marker_far_from_all_others_has_no_neighbours(chain):
    names, positions, _ = chain
    far = np.random.default_rng(1).normal(0, 3000, (len(positions), 1, 3))
    mesh = infer_mesh([recording([*names, "far"], np.concatenate((positions, far), axis=1))], options=OPTIONS)
    assert mesh.neighbours["far"] == ()


@pytest.mark.parametrize("positions", [np.full((100, 3, 3), np.nan), np.zeros((0, 3, 3)), np.ones((20, 3, 3))])
def test_nothing_to_infer_from(positions):
    mesh = infer_mesh([recording("abc", positions)], options=OPTIONS)
    assert mesh.segments == ()
    assert mesh.predictors == {"a": (), "b": (), "c": ()}


def test_identical_trajectories_are_one_segment(chain):
    names, positions, _ = chain
    twice = np.concatenate((positions, positions[:, :1]), axis=1)
    mesh = infer_mesh([recording([*names, "copy"], twice)], options=OPTIONS)
    first, copy = labels(mesh, [names[0], "copy"])
    assert first == copy != -1
    assert mesh.predictors["copy"][0] == names[0]
    same = infer_mesh([recording("abcd", np.repeat(positions[:, :1], 4, axis=1))], options=OPTIONS)
    assert [s.markers for s in same.segments] == [("a", "b", "c", "d")]


def test_markers_never_seen_together_are_unrelated():
    positions = subject(1)[1][:, :2].copy()
    positions[:700, 0] = positions[700:, 1] = np.nan
    mesh = infer_mesh([recording("ab", positions)], options=OPTIONS)
    assert [(s.markers, s.component) for s in mesh.segments] == [(("a",), 0), (("b",), 1)]
    assert mesh.predictors == {"a": (), "b": ()}


def test_recordings_are_pooled_and_their_order_does_not_matter(chain, chain_mesh):
    names, positions, _ = chain
    first = recording(names[1:], positions[:700, 1:], name="a")
    second = recording(names, positions[700:], name="b")
    static = recording(names, np.repeat(positions[:1], 500, axis=0), name="c", kind="static")
    one, other = (
        infer_meshes(group, supplied=[], options=OPTIONS)
        for group in ([first, second, static], [static, second, first])
    )
    assert one == other
    assert [mesh.recordings for mesh in one] == [("a", "b", "c")]
    assert edges(one[0]) == edges(chain_mesh)
    assert one[0].absent == {"a": (names[0],)}
    assert one[0].warnings == one[0].lacks == ()
    assert one[0].segments == infer_mesh([first, second], options=OPTIONS).segments
    alone = infer_mesh([static], options=OPTIONS)
    assert len(alone.segments) == 1
    assert len(alone.lacks) >= 2


def test_recordings_with_other_markers_get_a_mesh_of_their_own():
    shapes = {"a": "pqrst", "b": "uvwxy", "c": "pqrs", "d": "pqr"}
    recordings = [recording(names, np.zeros((5, len(names), 3)), name=name) for name, names in shapes.items()]

    def grouped(overlap):
        return [[r.facts["recording"] for r in g] for g in group_recordings(recordings, marker_overlap=overlap)]

    assert grouped(0.8) == [["b"], ["a", "c"], ["d"]]
    assert grouped(0.75) == [["b"], ["a", "c", "d"]]


def test_inputs_stay_as_they_are(chain):
    names, positions, _ = chain
    whole = recording(names, positions)
    infer_mesh([whole], options=replace(OPTIONS, max_frames=200))
    np.testing.assert_array_equal(whole.positions, positions)
