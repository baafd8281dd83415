"""Labels of real recordings that were exchanged on purpose: between two subjects, and in most of a trial of a session."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.core.labels import undo_exchanges
from markermend.core.recording import Recording

LABELS = {"detect": ["labels"]}


def exchange(recording, pairs, start, stop, *, gap):
    """The recording with pairs of labels exchanged over a stretch, behind a gap of all of them; and as it was, with the gap."""
    clean = recording.positions.copy()
    members = [recording.markers.index(name) for pair in pairs for name in pair]
    clean[start - gap : start, members] = np.nan
    if stop < len(clean):
        clean[stop : stop + gap, members] = np.nan
    positions = clean.copy()
    for first, second in zip(members[::2], members[1::2], strict=True):
        positions[start:stop, [first, second]] = clean[start:stop, [second, first]]
    return replace(recording, positions=positions), clean


def undone(recording, *session):
    """Positions with the exchanges that are found undone, and whether anything else was found."""
    options = api.Options.read(LABELS)
    found = api.detect(recording, api.infer_mesh([recording, *session], options=options), options)["labels"]
    exchanges = [event for event in found if event.partner]
    return undo_exchanges(recording.positions, exchanges, recording.markers), len(found) - len(exchanges)


@pytest.fixture(scope="module")
def two_subjects(data):
    """Six seconds of two subjects beside each other, the second turned: one frame rate, the same names after another prefix."""
    first, second = (api.read(data / "clean" / name, kind="dynamic") for name in ("85_02.c3d", "85_12.c3d"))
    names = [name.rpartition(":")[2] for name in first.markers]
    columns = [[own.rpartition(":")[2] for own in second.markers].index(name) for name in names]
    other = second.positions[1200:1920, columns]
    centre = np.nanmedian(other, axis=(0, 1))
    other = (other - centre) @ np.array([[-0.4, 0.9, 0.0], [-0.9, -0.4, 0.0], [0.0, 0.0, 1.0]]) / np.hypot(0.4, 0.9)
    place = np.nanmedian(first.positions, axis=(0, 1)) + np.array([1100.0, 0.0, 0.0])
    return Recording(
        tuple(f"{prefix}:{name}" for prefix in "AB" for name in names),
        np.concatenate([first.positions[:720], other + place], axis=1),
        first.rate,
        facts={"recording": "both", "subject": "S", "kind": "dynamic"},
    )


def between(names):
    return [(f"A:{name}", f"B:{name}") for name in names]


@pytest.mark.data
@pytest.mark.parametrize("gap", [0, 12])
@pytest.mark.parametrize(
    "pairs",
    [
        between(["LKNE"]),
        [("A:LELB", "B:RWRA")],
        between(["LKNE", "LANK", "LHEE", "LTOE", "LMT5"]),
        between(["RUPA", "RELB", "RFRM", "RWRA", "RWRB", "RFIN"]),
    ],
)
def test_exchanges_between_two_subjects(two_subjects, pairs, gap):
    pairs = [pair for pair in pairs if set(pair) <= set(two_subjects.markers)]
    damaged, clean = exchange(two_subjects, pairs, 300, 420, gap=gap)
    found, others = undone(damaged)
    assert np.array_equal(found, clean, equal_nan=True) and not others


@pytest.mark.data
def test_exchanges_between_rigid_bodies_of_two_subjects(data):
    """Exactly over its stretch: what is exchanged back continues, so that nothing else may change there."""
    whole = api.read(data / "field" / "two_persons.c3d", kind="dynamic")
    recording = replace(whole, positions=whole.positions[:950])
    legs = [
        f"{segment}{axis}"
        for segment in ("PELV", "LULE", "LLLE", "LFOO", "RULE", "RLLE", "RFOO")
        for axis in ("", "Y", "Z")
    ]
    pairs = [(f"Human1:{name}", f"Human2:{name}") for name in legs]
    damaged, clean = exchange(recording, pairs, 777, 950, gap=0)
    found, others = undone(damaged)
    assert np.array_equal(found, clean, equal_nan=True) and not others


@pytest.mark.data
@pytest.mark.parametrize("gap", [0, 10])
@pytest.mark.parametrize(
    "pairs",
    [
        [("L_knee", "r_knee")],
        [("L_thigh2", "L_knee")],
        [("L_toe", "r_toe"), ("L_5meta", "r_5meta"), ("L_calc", "r_calc"), ("L_ankle", "r_ankle")],
    ],
)
def test_the_other_recordings_say_that_most_of_a_trial_is_exchanged(data, pairs, gap):
    trial, *session = (
        api.read(data / "sessions" / "expert1" / f"{name}.trc", subject="expert1", kind="dynamic")
        for name in ("squats1", "walking1", "STSFast1", "DJAsym1")
    )
    start = round(0.3 * trial.frames)
    damaged, clean = exchange(trial, pairs, start, trial.frames, gap=gap)
    found, others = undone(damaged, *session)
    assert np.array_equal(found, clean, equal_nan=True) and not others


@pytest.mark.data
def test_close_markers_are_not_exchanged_throughout_on_little_evidence(data):
    names = [path.stem for path in sorted((data / "sessions" / "expert1").iterdir())]
    session = {name: api.read(data / "sessions" / "expert1" / f"{name}.trc", subject="expert1") for name in names}
    trial = session.pop("DJ2")
    found = api.detect(trial, api.infer_mesh([trial, *session.values()]), api.Options.read(LABELS))["labels"]
    spans = {event.marker: (event.start, event.stop) for event in found}
    # The two pass to each other in the last frame alone; those on the thigh are exchanged throughout.
    assert spans["R_wrist_radius"] == spans["R_wrist_ulna"] == (trial.frames - 1, trial.frames)
    assert spans["r_thigh3"] == spans["r_thigh5"] == (0, trial.frames)
