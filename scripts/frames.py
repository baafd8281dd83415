"""Detect faults of the capture system: repeated frames, jumps of all markers at once, slips of whole segments.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_frames.parquet, with warnings of a regular repetition of frames among its facts.
"""

from collections.abc import Sequence

from markermend.command import detector_stage
from markermend.detection.frames import detect_frames
from markermend.options.detection.frames import FramesOptions

STAGE = detector_stage.command("frames", __doc__, FramesOptions, finds="faults of the capture system")


def work(call: detector_stage.DetectorCall) -> str:
    given, recorded_under = detector_stage.arguments(call)
    found, warnings = detect_frames(**given)
    detector_stage.write(call, found, recorded_under, {"warnings": warnings})
    return detector_stage.result(found)


def main(argv: Sequence[str] | None = None) -> None:
    detector_stage.run(STAGE, work, argv)


if __name__ == "__main__":
    main()
