"""Samples that a marker reaches and leaves in jumps are left out before a mesh is inferred; fast motion is not."""

import itertools

import numpy as np
import pytest

from markermend.mesh.continuity import longest_course, without_displaced_samples
from markermend.mesh.inference import infer_mesh, prepare
from markermend.options.mesh import MeshOptions
from support.bodies import recording, subject

OPTIONS = MeshOptions()


@pytest.fixture(scope="module")
def chain():
    names, positions, _ = subject(1, tree=(None, 0, 1), frames=600)
    return names, positions


def displaced(names, positions):
    """Which samples are left out."""
    whole = recording(names, positions)
    left = without_displaced_samples(whole, min_jump_mm=300, jump_factor=3)
    np.testing.assert_array_equal(left.positions[~left.missing], positions[~left.missing])
    return left.missing & ~whole.missing


@pytest.mark.parametrize("place", [(0, 15), (100, 101), (100, 140), (300, 600)])
@pytest.mark.parametrize("where", [3000.0, 9999.0, "fixed"])
def test_a_displaced_stretch_is_left_out(chain, place, where):
    names, positions = chain
    spoilt, span = positions.copy(), slice(*place)
    if where == "fixed":
        spoilt[span, 2] = (9999.0, -9999.0, 0.0)
    else:
        spoilt[span, 2] += where
    found = displaced(names, spoilt)
    expected = np.zeros_like(found)
    expected[span, 2] = True
    # Of two halves either may be the displaced one.
    assert np.array_equal(found, expected) or (place[1] - place[0] == 300 and found.sum() == 300)


def test_a_stretch_between_gaps_is_left_out(chain):
    names, positions = chain
    spoilt = positions.copy()
    spoilt[200:240, 4] += 3000
    spoilt[195:200, 4] = spoilt[240:243, 4] = np.nan
    found = displaced(names, spoilt)
    assert np.flatnonzero(found.any(axis=0)).tolist() == [4]
    assert np.flatnonzero(found[:, 4]).tolist() == list(range(200, 240))


def test_flicker_between_two_places_is_left_out(chain):
    names, positions = chain
    spoilt = positions.copy()
    spoilt[100:200:3, 1] += 2000
    assert np.flatnonzero(displaced(names, spoilt)[:, 1]).tolist() == list(range(100, 200, 3))


def test_motion_is_never_left_out(chain):
    names, positions = chain
    fast = positions.copy()
    fast[300:330, 0] += np.cumsum(np.full((30, 3), 300.0), axis=0)  # as far as 50 m/s, reached at once
    fast[330:, 0] = np.nan
    assert not displaced(names, positions).any()
    assert displaced(names, positions[::50]).sum() == 0
    assert not displaced(names, np.full((5, 3, 3), np.nan)[:, : len(names)].repeat(4, axis=1)).any()


def test_the_course_with_most_samples_is_found_as_by_trying_all():
    rng = np.random.default_rng(2)
    for _ in range(40):
        trajectory = np.cumsum(rng.normal(0, 40, (60, 3)) * (rng.random((60, 1)) < 0.2), axis=0)
        cuts = np.sort(rng.choice(np.arange(1, 60), 7, replace=False)).tolist()
        parts = [part for part in itertools.pairwise([0, *cuts, 60]) if rng.random() < 0.8] or [(0, 60)]

        def continuous(course, points=trajectory):
            return all(
                np.linalg.norm(points[b[0]] - points[a[1] - 1]) <= 60 + 2 * (b[0] - a[1] + 1)
                for a, b in itertools.pairwise(course)
            )

        courses = [c for k in range(1, len(parts) + 1) for c in itertools.combinations(parts, k) if continuous(c)]
        most = max(sum(stop - start for start, stop in course) for course in courses)
        found = longest_course(trajectory, parts, jump_mm=60, step_mm=2)
        assert continuous(found) and sum(stop - start for start, stop in found) == most


def test_a_marker_far_away_for_a_while_keeps_its_neighbours(chain):
    names, positions = chain
    spoilt = positions.copy()
    spoilt[100:160, 5] = 9999.0
    hidden = positions.copy()
    hidden[100:160, 5] = np.nan
    with_gap, far = (
        infer_mesh([prepare(recording(names, own), options=OPTIONS)], options=OPTIONS) for own in (hidden, spoilt)
    )
    assert far == with_gap
    assert len(far.neighbours[names[5]]) == len(names) - 1
