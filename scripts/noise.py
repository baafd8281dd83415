"""Detect heavy noise.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 03_noise.parquet.
"""

from markermend.command import detector
from markermend.detection import noise

STAGE = detector.stage("noise", __doc__, finds="heavy noise", presets=["default", "coordinates", "paper"])


def work(call):
    given, recorded_under = detector.arguments(call)
    found = noise.detect_noise(**given, settings=noise.settings(call.options))
    detector.write(call, found, recorded_under, {})
    return detector.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
