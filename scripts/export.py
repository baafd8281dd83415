"""Write the cleaned recording in its own format, the list of changes, and a certificate.

Reads: the original file, 01_markers.parquet, 07_filled.parquet.
Writes: cleaned.* (the original with only the changed samples overwritten; for CSV and TSV also cleaned.trc),
changes.tsv, certificate.json. A recording that was set aside is copied unchanged, and its certificate says so.
"""

import numpy as np

from markermend.command.stage import Stage
from markermend.core.recording import Recording, Restored
from markermend.export import change_table, write_back
from markermend.formats.text import trc
from markermend.storage import atomic, stage_files

STAGE = Stage("export", __doc__)
STAGE.reads("source", "the original file")
STAGE.reads("markers", "trajectories as ingested")
STAGE.reads("filled", "trajectories after repair and filling")
STAGE.writes("cleaned", "the cleaned recording, in the format of the original")
STAGE.writes("changes", "table of changes, in the capture program's frame numbers")
STAGE.writes("certificate", "what changed and that nothing else did, as JSON")
STAGE.writes("trc", "the cleaned recording as TRC besides", many=True)


def work(call):
    measured, restored = stage_files.read_recording(call.markers), stage_files.read_recording(call.filled)
    assert isinstance(restored, Restored)
    certificate = write_back.write_cleaned(call.source, call.cleaned, measured, restored)
    rows = change_table.list_changes(measured, restored)
    atomic.write_text(call.changes, change_table.changes_table(rows))
    for path in call.trc:
        trc.write_new(path, recording=restored)
    atomic.write_json(call.certificate, certificate)
    return f"{certificate['changed_samples']} samples changed in {len(rows)} places, every other byte equal"


def set_aside(call, note):
    certificate = write_back.pass_through(call.source, call.cleaned, note.stage, note.reason)
    atomic.write_text(call.changes, change_table.changes_table([]))
    for path in call.trc:
        trc.write_new(path, recording=Recording((), np.empty((0, 0, 3)), 1.0))
    atomic.write_json(call.certificate, certificate)


def main(argv=None):
    STAGE.run(work, argv, set_aside=set_aside)


if __name__ == "__main__":
    main()
