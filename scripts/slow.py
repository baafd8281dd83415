"""Detect slow changes.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 05_slow.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command import detector
from markermend.detection.slow import detect_slow
from markermend.options.detection.slow import SlowOptions

STAGE = detector.stage("slow", __doc__, SlowOptions, finds="slow changes")


def published(options: SlowOptions) -> Any:
    from markermend.detection.published.slow import make_detector

    return make_detector(options)


def work(call: detector.DetectorCall) -> str:
    return detector.search(call, detect_slow, published)


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
