"""Attribution of drifts: by distances on a rigid segment, and which neighbours are observed intermittently."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.core.events import Event
from markermend.detection.neighbour.drifts.attribution import DriftAttribution
from markermend.prediction.scene import Scene
from support.signals import options_of

OPTIONS = options_of("slow", "default")


def triangle(length, direction):
    return 10 * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))[:, None] * direction


@pytest.mark.parametrize("culprit", range(5))
def test_on_a_rigid_segment_the_distances_decide_whose_it_is(culprit):
    rng = np.random.default_rng(6)
    rotation = Rotation.from_rotvec(np.cumsum(rng.normal(0, 0.02, (400, 3)), axis=0)).as_matrix()
    rigid = np.einsum("tij,mj->tmi", rotation, rng.normal(0, 80, (5, 3)))
    loose = rigid.mean(axis=1, keepdims=True) + np.cumsum(rng.normal(0, 2, (400, 4, 3)), axis=0)
    positions = np.concatenate([rigid, loose], axis=1)
    positions[200:250, culprit] += triangle(50, [0.3, 0.2, -0.1])
    scene = Scene(positions, 100.0, [np.delete(np.arange(9), m) for m in range(9)])
    attribution = DriftAttribution(scene, None, OPTIONS)  # the evidence does not matter
    event = Event("culprit", 200, 250, 1.0, "xyz")
    for other in set(range(9)) - {culprit}:
        assert attribution.distances_change_more(culprit, other, event)
        assert not attribution.distances_change_more(other, culprit, event)


@pytest.mark.parametrize(("stop", "intermittent"), [(118, [1]), (160, [])])
def test_what_is_brief_depends_on_how_long_the_event_is(stop, intermittent):
    positions = np.zeros((300, 3, 3))
    positions[108:112, 1] = np.nan
    scene = Scene(positions, 100.0, [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])])
    attribution = DriftAttribution(scene, None, OPTIONS)
    assert attribution.intermittent_neighbours(0, Event("a", 100, stop, 2.0, "xyz")).tolist() == intermittent


@dataclass
class Claim:
    """Evidence that a drift displaces a marker by so much."""

    displaced: np.ndarray
    precise: bool = False
    max_distance_deviation_mm: float = np.inf

    def displacement(self, marker, event):
        return self.displaced

    def is_precise(self, marker, event):
        return self.precise


def turning_body(spread=0.0, seed=3):
    """Five markers on a turning body, with distances that vary by `spread` mm."""
    rng = np.random.default_rng(seed)
    rotation = Rotation.from_rotvec(np.cumsum(rng.normal(0, 0.02, (400, 3)), axis=0)).as_matrix()
    body = np.einsum("tij,mj->tmi", rotation, rng.normal(0, 80, (5, 3)))
    return body + spread * np.sin(np.arange(400)[:, None, None] / 9 + rng.uniform(0, 6, (5, 3)))


@pytest.mark.parametrize("precise", [False, True])
def test_who_keeps_its_distances_to_a_rigid_segment_has_not_drifted(precise):
    positions, event, displaced = turning_body(), Event("a", 200, 260, 2.0, "xyz"), np.array([4.0, 3.0, 2.0])
    near = [np.delete(np.arange(5), m) for m in range(5)]
    still = DriftAttribution(Scene(positions, 100.0, near), Claim(displaced, precise), OPTIONS)
    assert not still.shows_in_distances(0, event)
    drifted = positions.copy()
    drifted[200:260, 0] += displaced
    moved = DriftAttribution(Scene(drifted, 100.0, near), Claim(displaced, precise), OPTIONS)
    assert moved.shows_in_distances(0, event)


@pytest.mark.parametrize("precise", [False, True])
def test_who_turns_about_two_rigid_mates_has_not_drifted(precise):
    positions, event = turning_body(), Event("a", 200, 260, 2.0, "xyz")
    to_mates = positions[230, 1:3] - positions[230, 0]
    aside = np.cross(*to_mates)
    near = [np.delete(np.arange(5), m)[:2] for m in range(5)]
    claim = Claim(6 * aside / np.linalg.norm(aside), precise)
    assert not DriftAttribution(Scene(positions, 100.0, near), claim, OPTIONS).shows_in_distances(0, event)


@pytest.mark.parametrize("precise", [False, True])
def test_within_the_usual_range_of_the_distances_only_a_precise_drift_counts(precise):
    positions, event, displaced = turning_body(spread=12.0), Event("a", 200, 260, 2.0, "xyz"), np.array([9.0, 7, 5])
    positions[170:290, 0] = positions[170:290, 1:].mean(axis=1) + 60  # at rest, so that nothing but the drift shows
    positions[170:290, 1:] = positions[170, 1:]
    positions[170:290, 0] = positions[170, 0]
    positions[200:260, 0] += displaced
    near = [np.delete(np.arange(5), m) for m in range(5)]
    attribution = DriftAttribution(Scene(positions, 100.0, near), Claim(displaced, precise), OPTIONS)
    assert attribution.shows_in_distances(0, event) == precise


@pytest.mark.parametrize(("height", "limit_mm", "shown"), [(18, np.inf, False), (40, np.inf, True), (40, 3.0, False)])
def test_where_all_distances_vary_more_is_required_or_the_pose_may_be_rare(height, limit_mm, shown):
    positions, event = turning_body(spread=12.0), Event("a", 200, 260, 2.0, "xyz")
    positions[170:290] = positions[170]
    displaced = height * np.array([0.7, 0.6, 0.4])
    positions[200:260, 0] += displaced
    near = [np.delete(np.arange(5), m) for m in range(5)]
    claim = Claim(displaced, max_distance_deviation_mm=limit_mm)
    required = DriftAttribution(Scene(positions, 100.0, near), claim, OPTIONS).shows_in_distances(0, event)
    assert required == shown
    without = replace(OPTIONS, high_scale_factor=1.0, high_scale_mm=100.0)
    assert DriftAttribution(Scene(positions, 100.0, near), claim, without).shows_in_distances(0, event) == (
        limit_mm > 3
    )
