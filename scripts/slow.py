"""Detect slow changes.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 05_slow.parquet.
"""

from markermend import detection, slow, storage

STAGE = detection.stage("slow", __doc__, finds="slow changes", presets=["default", "paper"])


def work(call):
    given, _ = detection.arguments(call)
    found = slow.detect_slow(**given, settings=slow.settings(call.options))
    storage.write_events(call.events, found, call.facts)
    return detection.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
