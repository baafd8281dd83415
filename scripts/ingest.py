"""Bring a recording in: labelled markers in mm at a fixed rate, missing samples as NaN, and facts about the original.

Reads: the original file.
Writes: 01_markers.parquet.
"""

from markermend.command.stage import Stage, optional
from markermend.formats import files
from markermend.formats.ingest import ingest
from markermend.storage import stage_files
from markermend.storage.folder_names import printable

STAGE = Stage("ingest", __doc__)
STAGE.reads("source", "the original: .c3d, .trc, .csv or .tsv")
STAGE.writes("markers", "trajectories as ingested")
STAGE.option("recording", str, "name of the recording")
STAGE.option("subject", str, "name of the subject")
STAGE.option("kind", str, "dynamic, static (never repaired or filled), or auto", choices=["auto", "dynamic", "static"])
STAGE.option("rate", optional(float), "frames per second, Hz, in place of what the file says; none: the file's")
STAGE.option("unlabelled", str, "regular expressions for names of trajectories that nobody labelled", many=True)
STAGE.option("static_names", str, "regular expressions that occur in names of static recordings", many=True)
STAGE.option("static_motion_mm", float, "a recording is static if nine markers in ten move less than this, mm")


def work(call):
    options = dict(call.options)
    reading = files.read(call.source, unlabelled=options.pop("unlabelled"), rate=options.pop("rate"))
    recording = ingest(reading, source=printable(call.source.name), **options)
    recording.facts["source"]["sha256"] = call.facts["inputs"]["source"]
    stage_files.write_recording(call.markers, recording, call.facts)
    gone = recording.missing.mean()
    return (
        f"{recording.frames} frames of {len(recording.markers)} markers at {recording.rate:g} Hz, {gone:.1%} missing, "
        f"{recording.facts['kind']}, {len(recording.facts['warnings'])} warnings"
    )


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
