"""Detect steps.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 04_steps.parquet, with the jumps that have no counterpart among its facts.
"""

from markermend.command import detector
from markermend.detection import steps

STAGE = detector.stage("steps", __doc__, finds="steps", presets=["default", "coordinates", "paper"])


def work(call):
    given, recorded_under = detector.arguments(call)
    found, left = steps.detect_steps(**given, settings=steps.settings(call.options))
    detector.write(call, found, recorded_under, {"open_steps": [vars(step) for step in left]})
    return f"{detector.result(found)}; {len(left)} open steps"


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
