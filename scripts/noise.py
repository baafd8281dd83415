"""Detect heavy noise.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 03_noise.parquet.
"""

from markermend.command import detector
from markermend.detection import noise
from markermend.storage import stage_files

STAGE = detector.stage("noise", __doc__, finds="heavy noise", presets=["default", "coordinates", "paper"])


def work(call):
    given, _ = detector.arguments(call)
    found = noise.detect_noise(**given, settings=noise.settings(call.options))
    stage_files.write_events(call.events, found, call.facts)
    return detector.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
