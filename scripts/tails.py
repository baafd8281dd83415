"""Detect noisy tails: samples beside a gap that wander off.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_tails.parquet.
"""

from collections.abc import Sequence

from markermend.command import detector_stage
from markermend.detection.tails import detect_tails
from markermend.options.detection.tails import TailsOptions

STAGE = detector_stage.command("tails", __doc__, TailsOptions, finds="noisy tails")


def work(call: detector_stage.DetectorCall) -> str:
    return detector_stage.search(call, detect_tails)


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
