"""Detect heavy noise.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 03_noise.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command import detector_stage
from markermend.detection.noise import detect_noise
from markermend.options.detection.noise import NoiseOptions

STAGE = detector_stage.command("noise", __doc__, NoiseOptions, finds="heavy noise")


def published(options: NoiseOptions) -> Any:
    from markermend.detection.published.noise import detect_noise as detect_published

    return detect_published


def work(call: detector_stage.DetectorCall) -> str:
    return detector_stage.search(call, detect_noise, published)


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
