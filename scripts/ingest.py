"""Bring a recording in: labelled markers in mm at a fixed rate, missing samples as NaN, and facts about the original.

Reads: the original file.
Writes: 01_markers.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.formats.ingest import check_unchanged, ingest_file
from markermend.options.general import RecordingOptions
from markermend.options.ingest import IngestOptions
from markermend.storage import source_file, stage_files

STAGE = Stage("ingest", __doc__, IngestOptions, RecordingOptions)
STAGE.reads_original("the original: .c3d, .trc, .csv or .tsv")
STAGE.writes("markers", "trajectories as ingested")


def work(call: Any) -> str:
    source_file.check(call.source, within=call.within, planned=call.sha256)
    recording = ingest_file(
        call.source,
        subject=call.subject,
        recording=call.recording,
        kind=call.kind,
        rate=call.rate,
        unit=call.unit,
        options=call.options,
    )
    check_unchanged(recording, [call.sha256, call.facts["inputs"]["source"]])
    stage_files.write_recording(call.markers, recording, call.facts)
    size = f"{recording.frames} frames of {len(recording.markers)} markers at {recording.rate:g} Hz"
    facts = f"{recording.facts['kind']}, {len(recording.facts['warnings'])} warnings"
    return f"{size}, {recording.missing.mean():.1%} missing, {facts}"


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
