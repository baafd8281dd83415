"""Geometry of markers: distances, rigid segments, limbs and the floor."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.simulation.marker_geometry import MarkerGeometry
from support.faults import site


def block(frames=300):
    """Six markers on a turning block, two others that wander."""
    rng = np.random.default_rng(1)
    corners = rng.uniform(-100, 100, (6, 3))
    turns = Rotation.from_euler("z", np.linspace(0, 90, frames)[:, None], degrees=True).as_matrix()
    rigid = np.einsum("nij,mj->nmi", turns, corners) + np.linspace(0, 500, frames)[:, None, None]
    loose = np.cumsum(rng.normal(0, 5, (frames, 2, 3)), axis=0) + 400
    return np.concatenate([rigid, loose], axis=1), turns


def block_geometry():
    return MarkerGeometry(block()[0], list("abcdefgh"))


def test_distances_and_rigid_segments():
    geometry = block_geometry()
    points = block()[0]
    assert geometry.distances[0, 1] == pytest.approx(np.linalg.norm(points[0, 0] - points[0, 1]))
    assert np.abs(geometry.deviations[:6, :6]).max() == pytest.approx(0, abs=1e-9)
    assert geometry.rigid(3, 1.0) == [0, 1, 2, 3, 4, 5]
    assert set(geometry.steadiest(2)[:5].tolist()) == {0, 1, 3, 4, 5}


def test_vectors_turn_with_the_body():
    vectors = np.tile([10.0, 0.0, 5.0], (200, 1))
    turned = block_geometry().turned(vectors, 0, 50)
    turns = block()[1]
    assert np.allclose(turned, np.einsum("nij,nj->ni", turns[50:250] @ turns[50].T, vectors))


@pytest.mark.parametrize(
    ("names", "pairs"),
    [
        (["S:LANK", "S:RANK", "S:C7", "S:LKNE"], [(0, 1)]),
        (["L_knee", "r_knee", "L.ASIS", "r.ASIS"], [(0, 1), (2, 3)]),
        (["Tete.L", "Tete.R", "STRN", "LEL"], [(0, 1)]),
    ],
)
def test_sides_are_told_by_names(names, pairs):
    geometry = MarkerGeometry(np.zeros((10, 4, 3)), names)
    assert geometry.sides == pairs


def test_vertical_axis_and_floor():
    geometry = site().geometry
    assert geometry.vertical == 2
    assert 0 < geometry.floor < 120
