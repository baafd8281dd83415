"""Counterparts by name."""

from markermend.detection.labelling.groups import counterparts_by_side, counterparts_by_subject


def test_counterparts_by_their_names():
    names = ("L_knee", "r_knee", "LTHI", "RTHI", "C7", "pLeftASI", "pRightASI", "CLAV")
    assert counterparts_by_side(names) == {0: 1, 1: 0, 2: 3, 3: 2, 5: 6, 6: 5}
    assert counterparts_by_subject(("A:HEAD", "B:HEAD", "A:HAND", "C7")) == {0: 1, 1: 0}
