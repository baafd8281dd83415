"""Detect frozen markers: positions that repeat exactly while the neighbours move on.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_frozen.parquet.
"""

from collections.abc import Sequence

from markermend.command import detector_stage
from markermend.detection.frozen import detect_frozen
from markermend.options.detection.frozen import FrozenOptions

STAGE = detector_stage.command("frozen", __doc__, FrozenOptions, finds="frozen stretches")


def work(call: detector_stage.DetectorCall) -> str:
    return detector_stage.search(call, detect_frozen)


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
