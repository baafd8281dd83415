"""The smallest drifts: drifts of the stated height are found, those of half of it are not."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.detection.slow import detect_slow
from markermend.numerics.matched_filter import raised_cosine
from markermend.prediction.scene import Scene
from support.signals import RIDGE, neighbours, options_of

OPTIONS = options_of("slow", "default")
FRAMES = 1500


@pytest.fixture(scope="module")
def body():
    """Markers of a turning body that slide on the soft tissue by different amounts."""
    rng = np.random.default_rng(4)
    time = np.arange(FRAMES)[:, None] / 100
    angles = np.sin(time * rng.uniform(1, 3, 3) + rng.uniform(0, 6, 3))
    turned = np.einsum("tij,mj->tmi", Rotation.from_rotvec(angles).as_matrix(), rng.normal(0, 120, (12, 3)))
    slide = [np.convolve(own, np.hanning(31) / 15, "same") for own in rng.normal(0, 1, (36, FRAMES))]
    size = np.linspace(1.0, 10.0, 12)[:, None]
    return turned + size * np.stack(slide, axis=1).reshape(FRAMES, 12, 3)


def search(positions):
    markers = [f"M{m:02}" for m in range(positions.shape[1])]
    scene = Scene(positions, 100.0, neighbours(positions))
    nothing = np.zeros(positions.shape, bool)
    return detect_slow(scene, markers=markers, earlier=nothing, options=OPTIONS, predictor=RIDGE)


def test_drifts_of_the_stated_height_are_found_and_smaller_ones_are_not(body):
    found, smallest = search(body)
    assert found == []
    heights = np.array([np.nan if own is None else own for own in smallest.values()])
    known = np.flatnonzero(~np.isnan(heights))
    assert len(known) >= 8
    shares = []
    for part in (1.0, 0.5):
        rng, hits = np.random.default_rng(1), []
        for m in known:
            start, direction = int(rng.integers(100, FRAMES - 200)), rng.normal(size=3)
            drift = (
                raised_cosine((np.arange(FRAMES) + 0.5 - start) / 100)[:, None] * direction / np.linalg.norm(direction)
            )
            positions = body.copy()
            positions[:, m] += part * heights[m] * drift
            hits.append(any(e.marker == f"M{m:02}" and e.start < start + 50 < e.stop for e in search(positions)[0]))
        shares.append(np.mean(hits))
    assert shares[0] >= 0.8
    assert shares[1] <= 0.3


def test_a_marker_that_is_predicted_worse_has_a_higher_one(body):
    heights = list(search(body)[1].values())
    assert np.mean(heights[-4:]) > 1.2 * np.mean(heights[:4])


def test_none_is_stated_where_a_marker_cannot_be_judged(body):
    positions = body[:300].copy()
    positions[20:, 3] = np.nan
    assert search(positions)[1]["M03"] is None


def test_the_stated_duration_is_an_option(body):
    scene = Scene(body, 100.0, neighbours(body))
    markers, nothing = [f"M{m:02}" for m in range(12)], np.zeros(body.shape, bool)
    longer = replace(OPTIONS, estimated_drifts=replace(OPTIONS.estimated_drifts, stated_duration_s=2.0))
    own = {"markers": markers, "earlier": nothing, "predictor": RIDGE}
    assert detect_slow(scene, options=longer, **own)[1] != detect_slow(scene, options=OPTIONS, **own)[1]


def test_none_is_stated_of_a_marker_of_whose_neighbours_most_cannot_be_judged(body):
    positions = body[:600].copy()
    positions[20:, 5:] = np.nan
    near = neighbours(positions)
    without = replace(OPTIONS, estimated_drifts=replace(OPTIONS.estimated_drifts, stated_neighbour_share=0.0))
    own = {"markers": list("abcdefghijkl"), "earlier": np.zeros(positions.shape, bool), "predictor": RIDGE}
    stated = [
        detect_slow(Scene(positions, 100.0, near), options=options, **own)[1]["a"] for options in (without, OPTIONS)
    ]
    assert stated[0] is not None
    assert stated[1] is None
