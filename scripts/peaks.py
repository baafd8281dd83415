"""Detect isolated peaks.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_peaks.parquet.
"""

from markermend.command import detector
from markermend.detection import peaks

STAGE = detector.stage("peaks", __doc__, finds="isolated peaks", presets=["default", "coordinates", "paper"])


def work(call):
    given, recorded_under = detector.arguments(call)
    found = peaks.detect_peaks(**given, settings=peaks.settings(call.options))
    detector.write(call, found, recorded_under, {})
    return detector.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
