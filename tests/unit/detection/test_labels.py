"""Swapped labels: these intervals and partners, nothing on clean motion, and undone bit for bit."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.labels import undo_exchanges
from markermend.detection import labels
from markermend.formats import files
from markermend.options.detection.labels import LabelsOptions
from markermend.options.ingest import IngestOptions
from markermend.options.repair import RepairOptions
from markermend.prediction.scene import Scene
from markermend.repair.repair import repair_scene
from markermend.simulation.artifact_models import integers
from markermend.simulation.contamination import Contamination
from support.signals import neighbours

OPTIONS = LabelsOptions()


def find(recording):
    scene = Scene(recording.positions, recording.rate, neighbours(recording.positions))
    return labels.find_labels(scene, markers=recording.markers, options=OPTIONS).events


def intervals(found):
    return [(event.marker, event.start, event.stop, event.partner) for event in found]


def exchange(recording, a, b, *spans):
    """The recording with the samples of two markers exchanged over some intervals."""
    pair = [recording.markers.index(a), recording.markers.index(b)]
    positions = recording.positions.copy()
    for start, stop in spans:
        positions[start:stop, pair] = positions[start:stop, pair[::-1]]
    return replace(recording, positions=positions)


def both(a, b, *spans):
    return sorted((one, start, stop, other) for start, stop in spans for one, other in ((a, b), (b, a)))


def test_nothing_on_the_clean_walker(walker):
    for pace in (1, 2):
        assert find(replace(walker.recording, positions=walker.recording.positions[::pace], rate=100.0 / pace)) == []


@pytest.mark.parametrize("within", [90.0, 250.0, 5000.0])
@pytest.mark.parametrize("length", [1, 2, 10, 50, 200])
def test_found_with_partner_and_exact_bounds(walker, length, within):
    clean = walker.recording
    for seed in range(2):
        rng = np.random.default_rng([length, int(within), seed])
        harm = Contamination(clean.positions, clean.markers, margin=20, one_at_a_time=True, rng=rng)
        harm.swap(length=integers(length, length), within_mm=within, count=2)
        found = find(replace(clean, positions=harm.positions))
        assert intervals(found) == intervals(harm.events["labels"])
        assert all(event.score > 1 and event.axes == "xyz" for event in found)


def test_a_swap_that_comes_and_goes(walker):
    spans = [(100, 430), (500, 532), (700, 701)]
    assert intervals(find(exchange(walker.recording, "LTHI", "LKNE", *spans))) == both("LTHI", "LKNE", *spans)


@pytest.mark.parametrize("span", [(900, 1200), (0, 300)])
def test_a_swap_that_lasts_from_the_start_or_to_the_end(walker, span):
    assert intervals(find(exchange(walker.recording, "LTHI", "LKNE", span))) == both("LTHI", "LKNE", span)


@pytest.mark.parametrize("length", [10, 150])
def test_a_swap_with_a_missing_partner(walker, length):
    clean = walker.recording
    span = (600, 600 + length)
    recording = exchange(clean, "LTHI", "LKNE", span)
    recording.positions[slice(*span), clean.markers.index("LKNE")] = np.nan
    assert intervals(find(recording)) == both("LTHI", "LKNE", span)


def test_other_artifacts_are_no_swaps(contaminated):
    assert intervals(find(contaminated.recording)) == intervals(contaminated.events["labels"])


def test_a_step_to_where_another_marker_is_is_no_swap(walker):
    positions = walker.recording.positions.copy()
    a, b = walker.recording.markers.index("LTHI"), walker.recording.markers.index("LKNE")
    positions[600:650, a] = positions[600:650, b] + 5.0
    assert find(replace(walker.recording, positions=positions)) == []


def turned(recording, ring, start, stop):
    """The recording with what belongs to each marker of the ring under the label of the next; and the events."""
    positions = recording.positions.copy()
    own = [recording.markers.index(name) for name in ring]
    positions[start:stop, np.roll(own, -1)] = recording.positions[start:stop, own]
    expected = sorted((ring[k], start, stop, ring[(k + 1) % len(ring)]) for k in range(len(ring)))
    return replace(recording, positions=positions), expected


@pytest.mark.parametrize("ring", [("LTHI", "LKNE", "LTIB"), ("LTIB", "LKNE", "LTHI"), ("LASI", "RASI", "LPSI", "RPSI")])
@pytest.mark.parametrize("span", [(600, 601), (600, 650), (900, 1200), (0, 300)])
def test_markers_that_change_places_in_a_ring(walker, ring, span):
    recording, expected = turned(walker.recording, ring, *span)
    found = find(recording)
    assert intervals(found) == expected
    assert np.array_equal(undo_exchanges(recording.positions, found, recording.markers), walker.recording.positions)


def test_a_ring_that_turns_on_and_on(walker):
    once, expected = turned(walker.recording, ("LTHI", "LKNE", "LTIB"), 400, 450)
    twice, more = turned(once, ("LTIB", "LKNE", "LTHI"), 450, 480)
    found = find(twice)
    assert intervals(found) == sorted(expected + more)
    assert np.array_equal(undo_exchanges(twice.positions, found, twice.markers), walker.recording.positions)


def test_a_ring_is_undone_by_the_repair(walker):
    recording, expected = turned(walker.recording, ("LTHI", "LKNE", "LTIB"), 600, 650)
    options = RepairOptions()
    scene = Scene(recording.positions, recording.rate, neighbours(recording.positions))
    mended = repair_scene(recording, scene, found={"labels": find(recording)}, predictors={}, options=options)
    assert np.array_equal(mended.recording.positions, walker.recording.positions)
    assert sorted((e.marker, e.start, e.stop, e.partner) for e in mended.changes) == expected


def test_undone_bit_for_bit_alone_and_by_the_repair(walker):
    clean = walker.recording
    spans = [(100, 430), (500, 502)]
    recording = exchange(clean, "LTHI", "LKNE", *spans)
    found = find(recording)
    before = recording.positions.copy()
    assert np.array_equal(undo_exchanges(recording.positions, found, recording.markers), clean.positions)
    assert np.array_equal(recording.positions, before)
    options = RepairOptions()
    scene = Scene(recording.positions, recording.rate, neighbours(recording.positions))
    mended = repair_scene(recording, scene, found={"labels": found}, predictors={}, options=options)
    assert np.array_equal(mended.recording.positions, clean.positions)


@pytest.mark.data
@pytest.mark.parametrize(
    ("name", "pair", "spans"),
    [
        ("raw/2022_01_0403.c3d", ("LTH1", "LTH2"), [(194, 801), (904, 936)]),
        ("clean/85_02.c3d", ("", ""), []),
        ("clean/STS1.trc", ("", ""), []),
        ("clean/Qualisys.c3d", ("", ""), []),
    ],
)
def test_real_recordings(data, name, pair, spans):
    recording = files.read(data / name, unlabelled=IngestOptions().unlabelled, rate=None).recording
    assert intervals(find(recording)) == both(*pair, *spans)
