"""Detect steps.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 04_steps.parquet, with the jumps that have no counterpart among its facts.
"""

from markermend import detection, steps, storage

STAGE = detection.stage("steps", __doc__, finds="steps", presets=["default", "coordinates", "paper"])


def work(call):
    found, left = steps.detect_steps(**detection.arguments(call), settings=steps.settings(call.options))
    storage.write_events(call.events, found, {**call.facts, "open_steps": [vars(step) for step in left]})
    return f"{detection.result(found)}; {len(left)} open steps"


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
