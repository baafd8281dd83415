"""Detect exchanged labels: markers that stand under each other's labels over a stretch.

Reads: 01_markers.parquet, mesh.json.
Writes: 02_labels.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command import detector
from markermend.detection.labels import detect_labels
from markermend.options.detection import LabelsOptions
from markermend.storage import stage_files

STAGE = detector.files("labels", __doc__, finds="label exchanges")
STAGE.option("ratio", float, "what is left of a jump, once two labels are exchanged, is at most this part of it")
STAGE.option("jump", float, "a marker jumps that departs so many times the usual from its usual motion")
STAGE.option("window_s", float, "time over which that usual motion is taken, s")
STAGE.option("floor_mm", float, "least jump, mm")
STAGE.option("near", int, "neighbours of either marker whose distances show which label is which")
STAGE.option("trust", float, "labels as recorded weigh as much as distances of this clearness (0 to 1)")
STAGE.option("clear", float, "how clearly both together must show the exchanged part (0 to 1)")


def work(call: Any) -> str:
    recording, scene, _, _ = detector.read(call.markers, call.mesh, call.earlier, as_recorded=True)
    found = detect_labels(scene, markers=recording.markers, settings=LabelsOptions(**call.options))
    stage_files.write_events(call.events, found, call.facts)
    return detector.result(found)


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
