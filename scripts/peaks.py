"""Detect isolated peaks.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_peaks.parquet.
"""

from markermend import detection, peaks, storage

STAGE = detection.stage("peaks", __doc__, finds="isolated peaks", presets=["default", "coordinates", "paper"])


def work(call):
    given, _ = detection.arguments(call)
    found = peaks.detect_peaks(**given, settings=peaks.settings(call.options))
    storage.write_events(call.events, found, call.facts)
    return detection.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
