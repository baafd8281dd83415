"""Detect steps.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 04_steps.parquet, with the jumps that have no counterpart among its facts.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command import detector_stage
from markermend.command.presets import preset_detector
from markermend.detection.steps import detect_steps
from markermend.options.detection.steps import StepsOptions

STAGE = detector_stage.command("steps", __doc__, StepsOptions, finds="steps")


def published(options: StepsOptions) -> Any:
    from markermend.detection.published.steps import detect_steps as detect_published

    return detect_published


def work(call: detector_stage.DetectorCall) -> str:
    given, recorded_under = detector_stage.arguments(call)
    found, left = preset_detector(detect_steps, call.options, published)(**given)
    detector_stage.write(call, found, recorded_under, {"open_steps": [vars(step) for step in left]})
    return f"{detector_stage.result(found)}; {len(left)} open steps"


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
