"""Small recordings at random, with too little in them for most of the chain: whatever can be done is done, without a failure."""

from collections.abc import Iterator

import numpy as np
import pytest

from markermend import api
from markermend.core.recording import MEASURED, Recording, changed

RECORDINGS = 60


def motion(rng: np.random.Generator, frames: int, markers: int, rate: float) -> np.ndarray:
    """Markers that rest, are carried as one body, or move each by itself, (frames, markers, 3), mm."""
    rest = rng.normal(0, rng.choice([30, 300, 3000]), (markers, 3))
    times = np.arange(frames)[:, None, None] / rate
    body = 300 * np.sin(2 * np.pi * times) + np.cumsum(rng.normal(0, 3, (frames, 1, 3)), axis=0)
    alone = np.cumsum(rng.normal(0, 5, (frames, markers, 3)), axis=0)
    return rest + [0 * alone, body + 0 * alone, body + rng.normal(0, 0.2, alone.shape), alone][rng.integers(4)]


def damage(rng: np.random.Generator, positions: np.ndarray) -> None:
    """Displace, repeat, exchange or shake a marker for some frames."""
    frames, markers, _ = positions.shape
    start, (m, other) = int(rng.integers(frames)), rng.integers(markers, size=2).tolist()
    span = slice(start, start + int(rng.integers(1, 20)))
    kinds = [
        positions[span, m] + rng.normal(0, rng.choice([30, 9999]), 3),
        np.broadcast_to(positions[start, m], positions[span, m].shape),
        positions[span, other].copy(),
        positions[span, m] + rng.normal(0, 10, positions[span, m].shape),
    ]
    chosen = int(rng.integers(4))
    if chosen == 2:
        positions[span, other] = positions[span, m]
    positions[span, m] = kinds[chosen]


def lose(rng: np.random.Generator, positions: np.ndarray) -> None:
    """Take samples away, of some recordings nearly all."""
    wanted = rng.choice([0, 0.1, 0.5, 0.95]) * rng.random(positions.shape[1])
    for m, share in enumerate(wanted):
        while np.isnan(positions[:, m, 0]).mean() < share:
            start = int(rng.integers(len(positions)))
            positions[start : start + int(rng.integers(1, 25)), m] = np.nan


def small_recordings() -> Iterator[Recording]:
    """Recordings of 1 to 8 markers over 1 to 80 frames."""
    for seed in range(RECORDINGS):
        rng = np.random.default_rng(seed)
        markers, frames, rate = int(rng.integers(1, 9)), int(rng.integers(1, 81)), float(rng.choice([10, 50, 100, 240]))
        positions = motion(rng, frames, markers, rate)
        for _ in range(int(rng.integers(4))):
            damage(rng, positions)
        lose(rng, positions)
        facts = {"recording": f"seed {seed}", "kind": "dynamic"}
        yield Recording(tuple("ABCDEFGH"[:markers]), positions, rate, facts=facts)


@pytest.mark.filterwarnings("error")
def test_small_recordings_are_cleaned_as_far_as_possible() -> None:
    cleaned = [api.clean(recording) for recording in small_recordings()]
    for one in cleaned:
        assert not (changed(one.measured, one.recording) & (one.recording.origin == MEASURED)).any()
        assert (np.isfinite(one.recording.positions).all(axis=2) | one.recording.missing).all()
    assert any(change.is_gap and change.method for one in cleaned for change in one.changes)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("frames", "markers"), [(1, 1), (3, 8), (5, 1), (80, 1), (80, 2), (59, 8)])
def test_what_cannot_be_judged_is_named(frames: int, markers: int) -> None:
    rng = np.random.default_rng(frames)
    recording = Recording(tuple("ABCDEFGH"[:markers]), motion(rng, frames, markers, 100.0), 100.0)
    cleaned = api.clean(recording)
    assert not changed(recording, cleaned.recording).any()
    assert set(cleaned.unjudged) == set(recording.markers)
    assert all(any(marker in text for text in cleaned.warnings) for marker in recording.markers)


def test_nothing_is_stated_of_drifts_in_recordings_shorter_than_a_bin_of_their_search() -> None:
    rng = np.random.default_rng(0)
    recording = Recording(tuple("ABCDEFGH"), motion(rng, 10, 8, 250.0), 250.0)
    cleaned = api.clean(recording)
    assert not changed(recording, cleaned.recording).any() and set(cleaned.unjudged) == set(recording.markers)


def test_markers_that_each_move_by_themselves() -> None:
    rng = np.random.default_rng(0)
    positions = 2000 * rng.normal(size=(1, 8, 3)) + np.cumsum(rng.normal(0, 20, (300, 8, 3)), axis=0)
    cleaned = api.clean(Recording(tuple("ABCDEFGH"), positions, 100.0))
    assert cleaned.changes == () and all(len(part.markers) == 1 for part in cleaned.mesh.segments)
