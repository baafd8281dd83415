"""Labels by level: exchanges across gaps, of whole limbs and of rings, found over these frames and undone bit for bit."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.labels import undo_exchanges
from markermend.detection.labels import find_labels
from markermend.mesh.inference import infer_mesh
from markermend.options.detection.labels import LabelsOptions
from markermend.options.mesh import MeshOptions
from markermend.prediction.scene import Scene

OPTIONS = LabelsOptions()
SEGMENTS = ("THI", "KNE", "TIB", "ANK", "HEE", "TOE")


def find(recording, *others):
    named = [replace(one, facts={"recording": f"r{k}"}) for k, one in enumerate((recording, *others))]
    mesh = infer_mesh(named, options=MeshOptions())
    return find_labels(Scene.of(recording, mesh), markers=recording.markers, options=OPTIONS).events


def intervals(found):
    return [(event.marker, event.start, event.stop, event.partner) for event in found]


def relabelled(recording, ring, start, stop, *, gaps):
    """The recording with each marker of a ring under the label of the next one, and without the gaps (label, start, stop)."""
    clean = recording.positions.copy()
    own = [recording.markers.index(name) for name in ring]
    for name, first, after in gaps:
        clean[first:after, recording.markers.index(name)] = np.nan
    positions = clean.copy()
    positions[start:stop, np.roll(own, -1)] = clean[start:stop, own]
    expected = sorted((ring[k], start, stop, ring[(k + 1) % len(ring)]) for k in range(len(ring)))
    return replace(recording, positions=positions), clean, expected


def shared(ring, *gaps):
    return [(name, *gap) for name in ring for gap in gaps]


def undone(recording, found):
    return undo_exchanges(recording.positions, found, recording.markers)


@pytest.mark.parametrize(
    "ring", [("LTHI", "LKNE"), ("LASI", "RASI"), ("LKNE", "RKNE"), ("LTHI", "LKNE", "LTIB"), ("LTIB", "RTHI", "LTHI")]
)
@pytest.mark.parametrize(("start", "stop"), [(500, 600), (800, 1200), (0, 300)])
def test_an_exchange_across_gaps(walker, ring, start, stop):
    gaps = [(start - 20, start)] * (start > 0) + [(stop, stop + 15)] * (stop < 1200)
    recording, clean, expected = relabelled(walker.recording, ring, start, stop, gaps=shared(ring, *gaps))
    found = find(recording)
    assert np.array_equal(undone(recording, found), clean, equal_nan=True)
    assert intervals(found) == expected


def test_an_exchange_that_ends_at_a_later_gap(walker):
    ring = ("LTHI", "LKNE")
    recording, clean, expected = relabelled(
        walker.recording, ring, 500, 800, gaps=shared(ring, (480, 500), (600, 615), (800, 820))
    )
    found = find(recording)
    assert intervals(found) == expected
    assert np.array_equal(undone(recording, found), clean, equal_nan=True)


def test_markers_that_are_lost_and_seen_again_at_different_moments(walker):
    gaps = [("LTHI", 480, 500), ("LKNE", 490, 520), ("LTHI", 700, 730), ("LKNE", 690, 710)]
    recording, clean, _ = relabelled(walker.recording, ("LTHI", "LKNE"), 500, 700, gaps=gaps)
    # The label of the knee is lost at 700, when the thigh, which it is on, is.
    found = find(recording)
    assert {event.marker for event in found} == {"LTHI", "LKNE"}
    assert np.array_equal(undone(recording, found), clean, equal_nan=True)


def test_the_longer_part_is_right_if_there_is_no_other_recording(walker):
    ring = ("LTHI", "LKNE")
    recording, _, _ = relabelled(walker.recording, ring, 400, 1200, gaps=shared(ring, (380, 400)))
    assert intervals(find(recording)) == sorted([("LTHI", 0, 380, "LKNE"), ("LKNE", 0, 380, "LTHI")])


def test_other_recordings_decide_where_most_is_exchanged(walker):
    ring = ("LTHI", "LKNE")
    recording, clean, expected = relabelled(walker.recording, ring, 400, 1200, gaps=shared(ring, (380, 400)))
    other = replace(walker.recording, positions=walker.recording.positions[::2])
    found = find(recording, other, other)
    assert intervals(found) == expected
    assert np.array_equal(undone(recording, found), clean, equal_nan=True)


@pytest.mark.parametrize("gap", [0, 12])
@pytest.mark.parametrize("lowest", [0, 2, 4])
def test_a_whole_limb_is_exchanged_or_nothing_of_it(walker, gap, lowest):
    pairs = [(f"L{name}", f"R{name}") for name in SEGMENTS[lowest:]]
    recording, clean = walker.recording, walker.recording.positions.copy()
    for pair in pairs:
        for name in pair:
            clean[500 - gap : 500, recording.markers.index(name)] = np.nan
            clean[650 : 650 + gap, recording.markers.index(name)] = np.nan
    positions = clean.copy()
    for pair in pairs:
        own = [recording.markers.index(name) for name in pair]
        positions[500:650, own] = clean[500:650, own[::-1]]
    found = find(replace(recording, positions=positions))
    expected = [(one, 500, 650, other) for pair in pairs for one, other in (pair, pair[::-1])]
    assert intervals(found) == sorted(expected)


def limbs_exchanged(recording, *limbs):
    """Limbs (names, start, stop, gap) with their sides exchanged, their markers lost before and after; and the same unexchanged."""
    positions, clean = recording.positions.copy(), recording.positions.copy()
    for names, start, stop, gap in limbs:
        for name in names:
            own = [recording.markers.index(side + name) for side in "LR"]
            positions[start:stop, own] = positions[start:stop, own[::-1]]
            for lost in (slice(start - gap, start), slice(stop, stop + gap)):
                positions[lost, own] = clean[lost, own] = np.nan
    expected = [
        (one, start, stop, other)
        for names, start, stop, _ in limbs
        for name in names
        for one, other in ((f"L{name}", f"R{name}"), (f"R{name}", f"L{name}"))
    ]
    return replace(recording, positions=positions), clean, sorted(expected)


@pytest.mark.parametrize("second", [(560, 620), (560, 720)])
def test_two_limbs_that_are_exchanged_at_overlapping_times(walker, second):
    recording, clean, expected = limbs_exchanged(
        walker.recording, (SEGMENTS[3:], 500, 650, 12), (("THI", "ASI", "PSI"), *second, 9)
    )
    found = find(recording)
    assert intervals(found) == expected
    assert np.array_equal(undone(recording, found), clean, equal_nan=True)


@pytest.mark.parametrize("seen", [("TOE",), ("HEE", "TOE")])
def test_a_limb_whose_end_is_seen_all_along(walker, seen):
    limb = [name for name in SEGMENTS[1:] if name not in seen]
    recording, clean, expected = limbs_exchanged(walker.recording, (limb, 500, 650, 12))
    found = find(recording)
    assert intervals(found) == expected
    assert np.array_equal(undone(recording, found), clean, equal_nan=True)


def test_a_label_on_a_marker_without_a_label(walker):
    recording, positions = walker.recording, walker.recording.positions.copy()
    a, b = recording.markers.index("LTHI"), recording.markers.index("LKNE")
    positions[480:500, a] = positions[650:660, a] = np.nan
    positions[500:650, a] = positions[500:650, b]
    positions[470:655, b] = np.nan
    found = find(replace(recording, positions=positions))
    assert intervals(found) == sorted([("LTHI", 500, 650, "LKNE"), ("LKNE", 500, 650, "LTHI")])
    mended = undo_exchanges(positions, found, recording.markers)
    assert np.array_equal(mended[500:650, b], recording.positions[500:650, b])
    assert np.isnan(mended[500:650, a]).all()


def test_nothing_where_markers_are_lost_but_labels_are_right(walker):
    positions = walker.recording.positions.copy()
    rng = np.random.default_rng(5)
    for _ in range(60):
        m, start = rng.integers(positions.shape[1]), rng.integers(0, 1150)
        positions[start : start + rng.integers(3, 80), m] = np.nan
    assert find(replace(walker.recording, positions=positions)) == []


def test_more_than_the_usual_share_is_exchanged_only_on_clear_evidence(walker):
    recording, _, expected = relabelled(
        walker.recording, ("LTHI", "LKNE"), 300, 1200, gaps=shared(("LTHI", "LKNE"), (280, 300))
    )
    strict = replace(OPTIONS, min_long_mean_gain=1e6)
    named = [replace(one, facts={"recording": f"r{k}"}) for k, one in enumerate((recording, walker.recording))]
    scene = Scene.of(recording, infer_mesh(named, options=MeshOptions()))
    found, left = (
        find_labels(scene, markers=recording.markers, options=options).events for options in (OPTIONS, strict)
    )
    assert intervals(found) == expected
    assert intervals(left) != expected
