"""A supplied mesh among the markers of the recordings: what is left out, passed on, and attached."""

import numpy as np
import pytest

from markermend.mesh.segment_tree import Skeleton
from markermend.mesh.user_mesh import UserMesh
from markermend.mesh.user_skeleton import attach_unnamed, fit_to_recordings

MARKERS = tuple("abcdefg")
SUPPLIED = UserMesh(
    names=("trunk", "arm", "hand"),
    members=(("b", "a"), ("x", "y"), ("c", "d", "z")),
    parents=(None, 0, 1),
    parent_markers=(None, "a", "x"),
)


@pytest.fixture
def attachment():
    costs = np.random.default_rng(1).uniform(10, 90, (7, 7))
    np.fill_diagonal(costs, 0)
    return costs


def test_empty_segments_pass_their_children_to_their_parent(attachment):
    skeleton, remarks = fit_to_recordings(SUPPLIED, MARKERS, range(4), attachment, max_cost_mm=100.0)
    assert skeleton.members == ((0, 1), (2, 3)) and skeleton.names == ("trunk", "hand")
    assert skeleton.parent == (None, 0)
    # Its own parent marker is gone: the cheapest of the new parent takes its place, and likewise for the root.
    costs = [attachment[[2, 3], m].mean() for m in (0, 1)]
    assert skeleton.parent_marker[1] == int(np.argmin(costs))
    costs = [attachment[[0, 1], m].mean() for m in (2, 3)]
    assert skeleton.parent_marker[0] == 2 + int(np.argmin(costs))
    assert remarks == ["named in the mesh file, held by no recording: x, y, z"]


def test_a_parent_marker_that_is_held_stays(attachment):
    supplied = UserMesh(("trunk", "hand"), (("a", "b"), ("c", "d")), (None, 0), ("d", "b"))
    skeleton, remarks = fit_to_recordings(supplied, MARKERS, range(4), attachment, max_cost_mm=100.0)
    assert skeleton.parent_marker == (3, 1) and remarks == []


def test_unnamed_markers_are_attached_only_below_the_largest_cost(attachment):
    named = Skeleton(((0, 1), (2, 3)), (None, 0), (2, 0), ("trunk", "hand"))
    attachment[4, :4], attachment[5, :4], attachment[6, :4] = [50, 20, 5, 30], [101, 102, 103, 104], np.nan
    skeleton = attach_unnamed(named, [4, 5, 6], attachment, max_cost_mm=100.0)
    assert skeleton.members == (*named.members, (4,), (5,), (6,))
    assert skeleton.parent == (None, 0, 1, None, None) and skeleton.parent_marker == (2, 0, 2, None, None)
    assert skeleton.names == ("trunk", "hand", None, None, None)
    _, remarks = fit_to_recordings(SUPPLIED, MARKERS, [0, 1, 2, 3, 5, 6], attachment, max_cost_mm=100.0)
    assert remarks[1] == "not named in the mesh file, attached to the nearest marker: f, g"


def test_a_mesh_without_any_held_marker_leaves_single_markers(attachment):
    supplied = UserMesh(("other",), (("p", "q"),), (None,), (None,))
    skeleton, _ = fit_to_recordings(supplied, MARKERS, [0, 3], attachment, max_cost_mm=100.0)
    assert skeleton.members == ((0,), (3,)) and skeleton.parent == (None, None)
