"""The truth about a contaminated file is a table of the capture program's frames."""

import numpy as np

from markermend.planning.recordings import Entry
from markermend.simulation.artifact_models import Recipe
from markermend.simulation.contaminated_files import COLUMNS, ContaminatedFile, table
from markermend.simulation.contamination import Contamination
from support.c3d_files import write


def protocol(positions, markers, *, rate, rng):
    """A step of 6 frames on the second marker, and a gap of the third at the end."""
    result = Contamination(positions, markers, margin=0, one_at_a_time=False, rng=rng)
    result.put("steps", Recipe(lambda _: 10.0, lambda _: 6, 1), marker=1, start=4, stop=10)
    result.gap(length=lambda _: 5, markers=[markers[2]], at="stop", count=1)
    return result


def test_rows_name_markers_frames_and_amplitudes(tmp_path):
    source = write(tmp_path / "walk.c3d", first_frame=701)
    entry = Entry("S01", "walk", str(source))
    made = ContaminatedFile.of(entry, protocol, unlabelled=[], rng=np.random.default_rng(1))
    step, gap = made.rows
    assert (step["class"], step["marker"], step["first_frame"], step["last_frame"]) == ("steps", "M1", 705, 710)
    assert len(step["axes"]) == 1 and abs(step[f"{step['axes']}_mm"]) == 10.0
    assert (gap["class"], gap["marker"], gap["first_frame"], gap["last_frame"]) == ("gaps", "M2", 716, 720)
    lines = table(made.rows).splitlines()
    assert lines[0].split("\t") == list(COLUMNS) and len(lines) == 3
