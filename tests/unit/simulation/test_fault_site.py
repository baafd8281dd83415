"""Sites of faults: free places, and what faults follow there."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.simulation.fault_site import Site
from support.faults import site, walking


def block(frames=300):
    """Six markers on a turning block, two others that wander."""
    rng = np.random.default_rng(1)
    corners = rng.uniform(-100, 100, (6, 3))
    turns = Rotation.from_euler("z", np.linspace(0, 90, frames)[:, None], degrees=True).as_matrix()
    rigid = np.einsum("nij,mj->nmi", turns, corners) + np.linspace(0, 500, frames)[:, None, None]
    loose = np.cumsum(rng.normal(0, 5, (frames, 2, 3)), axis=0) + 400
    return np.concatenate([rigid, loose], axis=1), turns


def block_site(markers="abcdefgh"):
    return Site(block()[0], list(markers), rate=100.0, margin_s=0.1, rng=np.random.default_rng(0))


def test_places_avoid_gaps_and_what_is_taken():
    place = site()
    _, clean = walking()
    for _ in range(20):
        start, m = place.place(60)
        assert not np.isnan(clean[start - 30 : start + 90, m]).any()
    place.take([0], 0, place.frames)
    assert 0 not in {place.place(10)[1] for _ in range(200)}
    assert place.place(10, among=[7])[1] == 7
    assert place.place(100, at="stop", among=[7]) == (place.frames - 100, 7)
    with pytest.raises(ValueError, match="no room"):
        place.place(10, among=[0])
    with pytest.raises(ValueError, match="no group"):
        place.place_group([], 10)


def test_distances_and_rigid_segments():
    place = block_site()
    points = block()[0]
    assert place.distances[0, 1] == pytest.approx(np.linalg.norm(points[0, 0] - points[0, 1]))
    assert np.abs(place.deviations[:6, :6]).max() == pytest.approx(0, abs=1e-9)
    assert place.rigid(3, 1.0) == [0, 1, 2, 3, 4, 5]
    assert set(place.steadiest(2)[:5].tolist()) == {0, 1, 3, 4, 5}


def test_vectors_turn_with_the_body():
    vectors = np.tile([10.0, 0.0, 5.0], (200, 1))
    turned = block_site().turned(vectors, 0, 50)
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
    place = Site(np.zeros((10, 4, 3)), names, rate=100.0, margin_s=0.1, rng=np.random.default_rng(0))
    assert place.sides == pairs


def test_vertical_axis_and_floor():
    place = site()
    assert place.vertical == 2
    assert 0 < place.floor < 120
