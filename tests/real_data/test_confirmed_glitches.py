"""The table of confirmed glitches: it names samples that are there, once each, on recordings that detection is measured on."""

import csv

import pytest

from markermend.core.artifacts import DETECTORS
from markermend.formats import files
from markermend.options.ingest import IngestOptions
from support.paths import PROJECT

TABLE = PROJECT / "benchmarks/support/confirmed_glitches.tsv"


@pytest.mark.data
def test_it_names_samples_that_are_there_once(data):
    rows = list(csv.DictReader(TABLE.open(encoding="utf-8", newline=""), delimiter="\t"))
    assert rows and all(row["class"] in DETECTORS and row["what"] for row in rows)
    for name in sorted({row["recording"] for row in rows}):
        [path] = (data / "clean").glob(f"{name}.*")
        recording = files.read(path, unlabelled=IngestOptions().unlabelled, rate=None).recording
        taken = recording.missing.copy()
        for row in (row for row in rows if row["recording"] == name):
            first, last = (int(row[key]) - recording.first_frame for key in ("first_frame", "last_frame"))
            assert 0 <= first <= last < recording.frames, row
            own = taken[first : last + 1, recording.markers.index(row["marker"])]
            assert not own.any(), row
            own[:] = True
