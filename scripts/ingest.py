"""Bring a recording in: labelled markers in mm at a fixed rate, missing samples as NaN, and facts about the original.

Reads: the original file.
Writes: 01_markers.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.formats import files
from markermend.formats.ingest import ingest
from markermend.options.general import RecordingOptions
from markermend.options.ingest import IngestOptions
from markermend.storage import stage_files
from markermend.storage.folder_names import printable

STAGE = Stage("ingest", __doc__, IngestOptions, RecordingOptions)
STAGE.reads("source", "the original: .c3d, .trc, .csv or .tsv")
STAGE.writes("markers", "trajectories as ingested")


def work(call: Any) -> str:
    reading = files.read(call.source, unlabelled=call.options.unlabelled, rate=call.rate)
    recording = ingest(
        reading,
        source=printable(call.source.name),
        recording=call.recording,
        subject=call.subject,
        kind=call.kind,
        static_names=call.options.static_names,
        static_motion_mm=call.options.static_motion_mm,
    )
    recording.facts["source"]["sha256"] = call.facts["inputs"]["source"]
    stage_files.write_recording(call.markers, recording, call.facts)
    gone = recording.missing.mean()
    return (
        f"{recording.frames} frames of {len(recording.markers)} markers at {recording.rate:g} Hz, {gone:.1%} missing, "
        f"{recording.facts['kind']}, {len(recording.facts['warnings'])} warnings"
    )


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
