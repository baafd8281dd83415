"""Detect slow changes.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 05_slow.parquet.
"""

from markermend import detection, hills, slow, storage
from markermend.predictors.loose import LOOSE
from markermend.stage import mapping

STAGE = detection.stage("slow", __doc__, finds="slow changes", presets=["default", "paper"])
for name in LOOSE:
    STAGE.option(name, mapping, f"settings of the predictor {name}, which the preset `paper` may use")


def work(call):
    given, _ = detection.arguments(call)
    settings = slow.settings(call.options)
    if isinstance(settings, hills.CoordinateSlow):
        given["predictor"] = hills.predictor(settings, call.options)
    found = slow.detect_slow(**given, settings=settings)
    storage.write_events(call.events, found, call.facts)
    return detection.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
