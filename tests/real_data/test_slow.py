"""Slow changes: drifts of the height that the stage states are found, smaller ones are not, and computed motion has none."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.command import detector
from markermend.core import events
from markermend.detection.slow import detect_slow
from markermend.numerics.matched_filter import raised_cosine
from markermend.options.detection.slow import SlowOptions

AT_ONCE = 8
"""Markers that drift in one copy."""


def search(recording, mesh):
    """What the stage finds, and the smallest drifts that it would have found."""
    given, _ = detector.detector_arguments(recording, mesh, [], options=SlowOptions())
    return detect_slow(**given)


@pytest.mark.data
@pytest.mark.parametrize("name", ["clean/STS1.trc", "clean/HDM_mm_01-02_03_120.c3d"])
def test_drifts_of_the_stated_height_are_found_and_smaller_ones_are_not(data, name):
    # With the joint centres, which are left alone otherwise: without them the seed draws other markers.
    recording = api.read(data / name, options=api.Options.read({"ingest": {"computed": []}}))
    mesh, length, rng = api.infer_mesh([recording]), round(recording.rate), np.random.default_rng(3)
    heights = search(recording, mesh)[1]
    known = [m for m, marker in enumerate(recording.markers) if heights[marker] is not None]
    hits = {1.0: [], 0.5: []}
    for markers in np.array_split(rng.permutation(known)[: 3 * AT_ONCE], 3):
        starts = rng.integers(length, recording.frames - 2 * length, len(markers))
        directions = rng.normal(size=(len(markers), 3))
        for part, found in hits.items():
            positions = recording.positions.copy()
            for m, start, direction in zip(markers, starts, directions, strict=True):
                drift = part * heights[recording.markers[m]] * direction / np.linalg.norm(direction)
                positions[start : start + length, m] += (
                    raised_cosine((np.arange(length)[:, None] + 0.5) / length) * drift
                )
            mask = events.mask(
                search(replace(recording, positions=positions), mesh)[0], recording.frames, recording.markers
            )
            found += [mask[start : start + length, m].mean() >= 0.5 for m, start in zip(markers, starts, strict=True)]
    assert np.mean(hits[1.0]) >= 0.8
    assert np.mean(hits[0.5]) <= 0.3


@pytest.mark.data
@pytest.mark.parametrize(
    "name", ["fast/golfswing.c3d", "fast/sprint.trc", "by_model/smpl_11_01.trc", "by_model/art_human.c3d"]
)
def test_fast_motion_and_models_have_no_slow_changes(data, name):
    recording = api.read(data / name)
    assert search(recording, api.infer_mesh([recording]))[0] == []
