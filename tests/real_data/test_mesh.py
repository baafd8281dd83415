"""Meshes of real 41-marker recordings against segments and joints that a person wrote down."""

from dataclasses import replace
from itertools import product

import ezc3d
import numpy as np
import pytest

from markermend.mesh.inference import infer_mesh
from markermend.options.mesh import MeshOptions
from support.bodies import adjusted_rand_index, labels, recording

OPTIONS = MeshOptions()
PARTS = {
    "head": "LFHD RFHD LBHD RBHD",
    "thorax": "C7 T10 CLAV STRN RBAC",
    "pelvis": "LFWT RFWT LBWT RBWT",
    "{}shoulder": "{}SHO",
    "{}arm": "{}UPA {}ELB",
    "{}forearm": "{}FRM {}WRA {}WRB",
    "{}hand": "{}FIN",
    "{}thigh": "{}THI {}KNE",
    "{}shank": "{}SHN {}ANK",
    "{}foot": "{}HEE {}TOE {}MT5",
}
PART = {
    marker.format(side): part.format(side)
    for (part, markers), side in product(PARTS.items(), "LR")
    for marker in markers.split()
}
UNAMBIGUOUS = ("head", "thorax", "pelvis", "Lforearm", "Rforearm", "Lfoot", "Rfoot")
JOINTS = {
    frozenset(part.format(side) for part in pair.split("-"))
    for pair in [
        "head-thorax",
        "thorax-pelvis",
        "thorax-{}shoulder",
        "thorax-{}arm",
        "{}shoulder-{}arm",
        "{}arm-{}forearm",
        "{}forearm-{}hand",
        "pelvis-{}thigh",
        "{}thigh-{}shank",
        "{}shank-{}foot",
    ]
    for side in "LR"
}
WINDOWS = {"85_12.c3d": 7, "HDM_mm_01-02_03_120.c3d": 7, "85_02.c3d": 1}
WINDOW_S = 10.0


def load(path):
    """Read the labelled markers of a complete recording in mm."""
    file = ezc3d.c3d(str(path))
    names = [label.strip().split(":")[-1] for label in file["parameters"]["POINT"]["LABELS"]["value"]]
    kept = [i for i, label in enumerate(names) if "*" not in label]
    positions = file["data"]["points"][:3, kept].transpose(2, 1, 0)
    rate = float(file["parameters"]["POINT"]["RATE"]["value"][0])
    return recording([names[i] for i in kept], positions, name=path.name, rate=rate)


@pytest.fixture(scope="module")
def windows(data):
    """Fifteen windows of at most 10 s with the mesh of each."""
    found = []
    for name, count in WINDOWS.items():
        whole = load(data / "clean" / name)
        length = min(round(WINDOW_S * whole.rate), whole.frames)
        for start in np.linspace(0, whole.frames - length, count).astype(int):
            window = replace(whole, positions=whole.positions[start : start + length])
            found.append((window, infer_mesh([window], options=OPTIONS)))
    return found


def agreement(mesh, names):
    return adjusted_rand_index(labels(mesh, names), [PART[name] for name in names])


def right_edges(mesh):
    """For each edge, whether some marker of the child belongs to, or is jointed to, a part of the parent segment."""
    return [
        any(
            PART[a] == PART[b] or frozenset((PART[a], PART[b])) in JOINTS for a, b in product(s.markers, parent.markers)
        )
        for s in mesh.segments
        if s.parent is not None and (parent := mesh.segments[s.parent])
    ]


@pytest.mark.data
def test_segments_are_those_that_a_person_sees(windows):
    over_all = [agreement(mesh, window.markers) for window, mesh in windows]
    clear = [agreement(mesh, [m for m in window.markers if PART[m] in UNAMBIGUOUS]) for window, mesh in windows]
    print(f"adjusted Rand index {np.mean(over_all):.3f} over all, {np.mean(clear):.3f} over the unambiguous markers")
    assert np.mean(over_all) >= 0.6
    assert np.mean(clear) >= 0.9


@pytest.mark.data
def test_segments_hang_where_the_body_is_jointed(windows):
    right = [edge for _, mesh in windows for edge in right_edges(mesh)]
    print(f"{sum(right)} of {len(right)} edges are joints")
    assert np.mean(right) >= 278 / 280
    assert all({segment.component for segment in mesh.segments} == {0} for _, mesh in windows)


@pytest.mark.data
def test_a_fifth_missing_at_random_changes_little(windows):
    window, mesh = windows[3]
    spoilt = window.positions.copy()
    spoilt[np.random.default_rng(1).random(spoilt.shape[:2]) < 0.2] = np.nan
    gappy = infer_mesh([replace(window, positions=spoilt)], options=OPTIONS)
    assert adjusted_rand_index(labels(gappy, window.markers), labels(mesh, window.markers)) >= 0.8


@pytest.mark.data
def test_the_motion_of_a_short_recording_is_too_little(windows):
    assert not any(mesh.lacks for _, mesh in windows)
    window, _ = windows[0]
    short = infer_mesh([replace(window, positions=window.positions[:300])], options=OPTIONS)
    assert short.lacks[0].startswith("only 2.5 s of motion")
