"""Detect faults of labels: markers under each other's labels, labels on something else, and markers without their labels.

Reads: 01_markers.parquet, mesh.json.
Writes: 02_labels.parquet, with warnings of exchanges of which nothing says which part is right, and of samples that may
lie under unlabelled trajectories, among its facts.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command import detector, detector_stage
from markermend.detection.labels import detect_labels
from markermend.options.detection.labels import LabelsOptions
from markermend.storage import stage_files

STAGE = detector_stage.command("labels", __doc__, LabelsOptions, finds="faults of labels")


def work(call: Any) -> str:
    recording = call.files.recording(call.markers)
    mesh = call.files.mesh(call.mesh, recording)
    found, warnings = detect_labels(**detector.labels_arguments(recording, mesh, call.options))
    stage_files.write_events(call.events, found, {**call.facts, "warnings": warnings})
    return detector_stage.result(found)


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
