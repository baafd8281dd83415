"""Recordings that went through every stage: a small one worked out by hand, and the contaminated walker."""

from dataclasses import replace

import numpy as np
import pytest

import qc
from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Change
from markermend.core.recording import FILLED, MISSING, Recording, Restored
from markermend.report.open_findings import worst_first
from support import report_files
from support.report_files import Results
from support.small_result import PEAK, RECORD


@pytest.fixture
def before() -> Recording:
    positions = np.arange(90.0).reshape(10, 3, 3)
    positions[4:7, 1] = np.nan
    positions[9, 2] = np.nan
    return Recording(("A", "B", "C"), positions, 10.0, 101, {"recording": "r", "subject": "s", "kind": "dynamic"})


@pytest.fixture
def after(before: Recording) -> Restored:
    """A: a peak of two samples repaired by 3, 4, 0 mm. B: two of three missing samples filled, one taken away."""
    positions = before.positions.copy()
    positions[2:4, 0] += (3.0, 4.0, 0.0)
    positions[4:6, 1] = 7.0
    positions[0, 1] = np.nan
    origin = np.where(np.isnan(positions).any(axis=2), MISSING, 0).astype(np.uint8)
    origin[2:4, 0], origin[4:6, 1] = PEAK, FILLED
    error = np.where(origin == MISSING, np.nan, 0.0)
    error[2:4, 0], error[4:6, 1] = 1.0, (2.0, 6.0)
    return Restored(before.markers, positions, 10.0, 101, before.facts, origin, error, 2 * error)


@pytest.fixture
def changes(before: Recording, after: Restored) -> list[Change]:
    return worst_first(applied_changes(before, after, RECORD))


@pytest.fixture(scope="module")
def made(contaminated, tmp_path_factory) -> Results:
    """The contaminated walker with all but one marker mended, judged."""
    keep = (contaminated.gaps[2][0],)
    before = report_files.named(replace(contaminated.recording, first_frame=705), "Walk 1", "Anna", unlabelled=["*0"])
    after = report_files.restore(before, contaminated.clean.positions, contaminated.events, error=4.0, keep=keep)
    results = report_files.write(tmp_path_factory.mktemp("results"), before, after, contaminated.events)
    qc.main(results.qc())
    return results
