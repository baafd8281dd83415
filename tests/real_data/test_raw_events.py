"""What is known to be wrong in raw recordings is found, in its class, by all detectors one after the other."""

import numpy as np
import pytest

from benchmarks.accuracy import detection
from markermend import api
from markermend.core.artifacts import DETECTORS

KNOWN = [
    ("2022_01_0403.c3d", {"labels": [("LTH1", 194, 801), ("LTH2", 194, 801), ("LTH1", 904, 936), ("LTH2", 904, 936)]}),
    ("UNIPD_Walking2.c3d", {"peaks": [("RCA", 78, 84)]}),
    ("flicker_ee8cdcfd_markers.trc", {"noise": [("RFHD", 0, 230), ("CLAV", 325, 360)]}),
]
"""Class, marker and half-open interval of what a person saw there."""


@pytest.mark.data
@pytest.mark.parametrize(("name", "known"), KNOWN)
def test_what_a_person_saw_is_found(data, name, known):
    """Nearly all of it: where it begins and ends is a matter of taste, but for swapped labels."""
    recording = api.read(data / "raw" / name)
    found = api.detect(recording, api.infer_mesh([recording]))
    classes = detection.classes(found, recording)
    for kind, places in known.items():
        for marker, start, stop in places:
            right = classes[:, recording.markers.index(marker)] == 1 + DETECTORS.index(kind)
            assert right[start:stop].mean() > 0.8
            if kind == "labels":
                assert np.array_equal(np.flatnonzero(np.diff(right.astype(int))) + 1, [194, 801, 904, 936])
