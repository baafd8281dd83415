"""Detect slow changes.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 05_slow.parquet.
"""

from markermend.command import detector
from markermend.command.stage import mapping
from markermend.detection import slow as detection_slow
from markermend.detection.published import slow
from markermend.options.published import PublishedSlowOptions
from markermend.prediction.lagged_regression.predictor import LAGGED_REGRESSIONS

STAGE = detector.stage("slow", __doc__, finds="slow changes", presets=["default", "paper"])
for name in LAGGED_REGRESSIONS:
    STAGE.option(name, mapping, f"settings of the predictor {name}, which the preset `paper` may use")


def work(call):
    given, recorded_under = detector.arguments(call)
    settings = detection_slow.settings(call.options)
    if isinstance(settings, PublishedSlowOptions):
        given["predictor"] = slow.predictor(settings, call.options)
    found = detection_slow.detect_slow(**given, settings=settings)
    detector.write(call, found, recorded_under, {})
    return detector.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
