"""Files that failed once, each for its whole kind."""

import numpy as np
import pytest

from markermend import api
from markermend.core.events import Event

TOO_LITTLE = [
    ("finger_tap.trc", {"Thumb", "Index"}),
    ("clip50.trc", {"M2", "M5"}),
    ("ten_frames.c3d", set()),
]
"""Recordings that are too small for a body mesh, and the markers with exchanged labels."""


@pytest.mark.data
@pytest.mark.parametrize(
    ("name", "rate", "markers"),
    [
        ("doubled_tabs.trc", 100.0, 10),
        ("labels_spaces.trc", 100.0, 10),
        ("rate.trc", 25.0, 10),
        ("meters_word.c3d", 100.0, 6),
        ("khz.c3d", 1000.0, 6),
    ],
)
def test_headers(data, name, rate, markers):
    """The header's oddities neither stop the reader nor mislead it."""
    recording = api.read(data / "field" / name)
    assert recording.rate == rate
    assert recording.markers == tuple(f"M{number:02}" for number in range(markers))
    assert np.ptp(recording.positions[:, 0], axis=0).max() > 10


@pytest.mark.data
@pytest.mark.parametrize(("name", "exchanged"), TOO_LITTLE)
def test_too_little_for_a_mesh(data, name, exchanged):
    """Exchanged labels alone can be found; the markers that nothing else can judge are named."""
    recording = api.read(data / "field" / name)
    cleaned = api.clean(recording)
    assert {change.marker for change in cleaned.changes if change.method == "swap"} == exchanged
    assert len(cleaned.changes) == len(exchanged)
    assert set(cleaned.unjudged) == set(recording.markers)
    assert all(any(marker in text for text in cleaned.warnings) for marker in recording.markers)


@pytest.mark.data
@pytest.mark.parametrize(
    ("name", "found"), [("jump03m_found.trc", "steps"), ("jump3m.trc", "steps"), ("sentinel9999.trc", "")]
)
def test_a_marker_far_away(data, name, found):
    """The marker keeps its neighbours, its stretch is found and repaired; a number such as 9999 is a missing sample."""
    recording = api.read(data / "field" / name)
    cleaned = api.clean(recording)
    far = Event("R.Thigh.Upper", 75, 90, 1.0)
    events = [
        (stage, e.start, e.stop) for stage, own in cleaned.findings.items() for e in own if e.marker == far.marker
    ]
    assert events == ([(found, far.start, far.stop)] if found else [])
    place = slice(far.start, far.stop), recording.markers.index(far.marker)
    truth = api.read(data / "field" / "jump03m_found.trc").positions[place] - (200.0, 150.0, -200.0)
    assert np.linalg.norm(cleaned.recording.positions[place] - truth, axis=1).max() < 6
    assert len(cleaned.mesh.neighbours[far.marker]) == 30


@pytest.mark.data
def test_samples_that_the_file_cannot_hold_are_refused(data, tmp_path):
    """HEADZ is outside of what the file's integers can state, and was written with the sign turned round."""
    source = data / "field" / "two_persons.c3d"
    cleaned = api.clean(api.read(source), options=api.Options.read({"detect": ["steps"]}))
    table = tmp_path / "changes.tsv"
    certificate = api.write(cleaned, source, tmp_path / "cleaned.c3d", changes=table)
    assert certificate["changed_samples"] == 0 and len(certificate["refused"]) == 10
    ((_, marker, first, last, *_, method, samples),) = [
        line.split("\t")[:12] for line in table.read_text().splitlines()[1:]
    ]
    assert (marker, int(first), int(last), method, int(samples)) == ("Human1:HEADZ", 963, 972, "refused", 10)
    assert source.read_bytes() == (tmp_path / "cleaned.c3d").read_bytes()
