"""Descriptors of a real recording of standing up and sitting down, beside those printed of "sitting" (skurowski2021, Table 2)."""

import pytest

from markermend import api
from markermend.evaluation.sequence_descriptors import describe_sequence

pytestmark = pytest.mark.data


def test_standing_up_is_like_the_printed_sitting(data):
    """Printed: 10.231 bits, 135 mm, 0.190 m/s, 2.86 m/s², 452 m/s³, 0.347, 0.016. Here nobody stands still in between."""
    options = api.Options.read({"ingest": {"computed": []}})  # with the hip joint centres
    recording = api.read(data / "clean" / "STS1.trc", options=options)
    found = describe_sequence(recording.positions, recording.rate)
    assert found.entropy == pytest.approx(9.09, abs=0.01)
    assert found.deviation == pytest.approx(73.4, abs=0.1)
    assert found.velocity == pytest.approx(0.361, abs=0.001)
    assert found.acceleration == pytest.approx(3.33, abs=0.01)
    assert found.jerk == pytest.approx(233, abs=1)
    assert (found.monotonicity, found.signed_monotonicity) == (
        pytest.approx(0.156, abs=0.001),
        pytest.approx(0.112, abs=0.001),
    )
    assert found.complexity == pytest.approx(0.002, abs=0.001)
