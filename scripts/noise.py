"""Detect heavy noise.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 03_noise.parquet.
"""

from markermend import detection, noise, storage

STAGE = detection.stage("noise", __doc__, finds="heavy noise", presets=["default", "coordinates", "paper"])


def work(call):
    given, _ = detection.arguments(call)
    found = noise.detect_noise(**given, settings=noise.settings(call.options))
    storage.write_events(call.events, found, call.facts)
    return detection.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
