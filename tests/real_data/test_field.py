"""Files that failed once, each for its whole kind."""

import os
import subprocess
import sys

import numpy as np
import pytest

from markermend import api
from markermend.core.events import Event
from support.paths import PROJECT

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
@pytest.mark.parametrize(("name", "missing"), [("swap_onesided.trc", (120, 160)), ("swap_with_gap.trc", (135, 145))])
def test_labels_exchanged_while_one_is_missing(data, tmp_path, name, missing):
    """They are undone and filled, and the changes are exported and listed."""
    source = data / "field" / name
    recording = api.read(source)
    cleaned = api.clean(recording)
    table = tmp_path / "changes.tsv"
    api.write(cleaned, source, tmp_path / name, changes=table)
    assert not cleaned.recording.missing.any()
    truth = api.read(data / "field" / "labels_spaces.trc").positions
    two = [recording.markers.index(marker) for marker in ("M02", "M05")]
    error = np.linalg.norm(cleaned.recording.positions[:, two] - truth[:, two], axis=2)
    gap = np.zeros(error.shape, bool)
    gap[slice(*missing)] = recording.missing[slice(*missing)][:, two[::-1]]
    assert gap.sum() == missing[1] - missing[0]
    assert error[~gap].max() == 0 and error[gap].max() < 2
    written = api.read(tmp_path / name)
    np.testing.assert_allclose(written.positions, cleaned.recording.positions, rtol=0, atol=0.000501)
    rows = [line.split("\t") for line in table.read_text().splitlines()[1:]]
    assert {(row[1], row[6]) for row in rows} == {("M02", "swap"), ("M05", "swap")}


@pytest.mark.data
def test_nothing_but_the_overflow_of_two_persons_is_altered(data):
    """All other points lie on rigid bodies, whose points cannot drift one by one."""
    cleaned = api.clean(api.read(data / "field" / "two_persons.c3d"))
    assert {
        (change.marker, change.start, change.stop) for change in cleaned.changes if change.outcome.value != "left"
    } == {("Human1:HEADZ", 962, 972)}


@pytest.mark.data
def test_a_thousand_frames_a_second_need_little_memory(data):
    """A recording of 20,000 frames is cleaned within 500 MB."""
    work = f"from markermend import api; api.clean(api.read({str(data / 'field/khz.c3d')!r}))"
    # The largest memory that the process itself needed; `getrusage` counts that of the process which started it.
    largest = "print(*[line.split()[1] for line in open('/proc/self/status') if line.startswith('VmHWM')])"
    call = [sys.executable, "-c", f"{work}; {largest}"]
    environment = {**os.environ, "PYTHONPATH": str(PROJECT / "scripts"), "OMP_NUM_THREADS": "1"}
    done = subprocess.run(call, env=environment, capture_output=True, text=True, check=True)
    assert int(done.stdout) < 500_000


@pytest.mark.data
def test_units_and_rates_are_said(data):
    """What was taken in place of what a header states is a warning, and what leaves no doubt none."""
    facts = {
        name: api.read(data / "field" / name).facts for name in ("rate.trc", "meters_word.c3d", "labels_spaces.trc")
    }
    assert facts["rate.trc"]["warnings"] == [
        "The header says 250 Hz, but the times are evenly spaced at 25 Hz, which is used."
    ]
    assert facts["meters_word.c3d"]["source"]["unit"] == "m" and facts["meters_word.c3d"]["warnings"] == []
    assert (
        facts["labels_spaces.trc"]["warnings"] == [] and "separated by blanks" in facts["labels_spaces.trc"]["notes"][0]
    )


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
