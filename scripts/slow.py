"""Detect slow changes.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 05_slow.parquet, with the smallest drift of each marker that would have been found among its facts (preset `default`).
"""

from collections.abc import Sequence
from typing import Any

from markermend.command import detector_stage
from markermend.command.presets import preset_detector
from markermend.detection.slow import detect_slow
from markermend.options.detection.slow import SlowOptions

STAGE = detector_stage.command("slow", __doc__, SlowOptions, finds="slow changes")


def published(options: SlowOptions) -> Any:
    from markermend.detection.published.slow import make_detector

    return make_detector(options)


def work(call: Any) -> str:
    given, recorded_under = detector_stage.arguments(call)
    found, smallest = preset_detector(detect_slow, call.options, published)(**given)
    stated = {"duration_s": call.options.estimated_drifts.stated_duration_s, "height_mm": smallest}
    detector_stage.write(call, found, recorded_under, {"smallest_drifts": stated} if smallest else {})
    return detector_stage.result(found)


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
