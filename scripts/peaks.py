"""Detect isolated peaks.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_peaks.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command import detector_stage
from markermend.detection.peaks import detect_peaks
from markermend.options.detection.peaks import PeaksOptions

STAGE = detector_stage.command("peaks", __doc__, PeaksOptions, finds="isolated peaks")


def published(options: PeaksOptions) -> Any:
    from markermend.detection.published.peaks import detect_peaks as detect_published

    return detect_published


def work(call: detector_stage.DetectorCall) -> str:
    return detector_stage.search(call, detect_peaks, published)


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
