"""Write the cleaned recording in its own format, the list of changes, and a certificate.

Reads: the original file, 01_markers.parquet, 07_filled.parquet, 07_changes.parquet.
Writes: changes.tsv, originals.parquet (what the changed samples were), certificate.json, and the cleaned file under its own name in the tree of
cleaned files (the original with only the changed samples overwritten; on request also as TRC). A recording that was set aside is copied unchanged,
and its certificate says so.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from markermend.command.stage import Stage
from markermend.core import decisions
from markermend.core.recording import Recording, Restored, SetAside
from markermend.core.remarks import with_remarks
from markermend.core.written import is_reported, written_changes
from markermend.export import undo, write_back
from markermend.export.change_table import change_table
from markermend.export.opensim_trc import write_opensim_trc
from markermend.options.general import DecisionOptions
from markermend.options.reporting import ExportOptions
from markermend.storage import atomic, change_file, stage_files

STAGE = Stage("export", __doc__, ExportOptions, DecisionOptions)
STAGE.reads_original("the original file")
STAGE.reads("markers", "trajectories as ingested")
STAGE.reads("filled", "trajectories after repair and filling")
STAGE.reads("record", "what repair and filling did to each stretch")
STAGE.writes("changes", "table of changes, in the capture program's frame numbers")
STAGE.writes("originals", "the original value of every changed sample, with its bytes")
STAGE.writes("certificate", "what changed and that nothing else did, as JSON")
STAGE.writes("cleaned", "the cleaned recording, in the format of the original")
STAGE.writes("trc", "the cleaned recording as TRC besides, with y up", many=True)
STAGE.keeps_outputs()


def work(call: Any) -> str:
    measured, restored = stage_files.read_recording(call.markers), stage_files.read_recording(call.filled)
    assert isinstance(restored, Restored)
    certificate = write_back.write_cleaned(call.source, call.cleaned, measured, restored)
    record = with_remarks(change_file.read(call.record), decisions.read(call.decisions, restored.first_frame))
    written = written_changes(measured, restored, record, certificate["refused"])
    rows = [*written.applied, *written.refused, *filter(is_reported, record)]
    atomic.write_text(call.changes, change_table(rows, restored))
    sha256 = certificate["original_sha256"]
    undo.keep_originals(call.originals, call.source, call.cleaned, measured, written, sha256=sha256, facts=call.facts)
    for path in call.trc:
        certificate["trc"] = write_opensim_trc(path, replace(restored, facts=measured.facts), call.options)
    write_back.write_certificate(call.certificate, certificate, call.cleaned)
    refused = f", {len(certificate['refused'])} refused" if certificate["refused"] else ""
    places = f"{certificate['changed_samples']} samples changed in {len(written.applied)} places"
    return f"{places}{refused}, every other byte equal"


def set_aside(call: Any, note: SetAside) -> None:
    certificate = write_back.pass_through(call.source, call.cleaned, note, within=call.within)
    nothing = Recording((), np.empty((0, 0, 3)), 1.0)
    atomic.write_text(call.changes, change_table([], nothing))
    stage_files.set_aside(call.originals, note.stage, note.reason)
    for path in call.trc:
        write_opensim_trc(path, nothing, call.options)
    write_back.write_certificate(call.certificate, certificate, call.cleaned)


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv, set_aside=set_aside)


if __name__ == "__main__":
    main()
