"""Detect isolated peaks.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_peaks.parquet.
"""

from markermend.command import detector
from markermend.detection import peaks
from markermend.storage import stage_files

STAGE = detector.stage("peaks", __doc__, finds="isolated peaks", presets=["default", "coordinates", "paper"])


def work(call):
    given, _ = detector.arguments(call)
    found = peaks.detect_peaks(**given, settings=peaks.settings(call.options))
    stage_files.write_events(call.events, found, call.facts)
    return detector.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
