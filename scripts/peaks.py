"""Detect isolated peaks.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_peaks.parquet.
"""

from markermend import detection, peaks, storage
from markermend.predictors.local import LocalRidge, RidgeOptions
from markermend.stage import Stage, mapping

STAGE = Stage("peaks", __doc__)
STAGE.reads("markers", "trajectories as ingested")
STAGE.reads("mesh", "who the neighbours are")
STAGE.reads("earlier", "events of the detectors before, whose samples are left out", many=True, optional=True)
STAGE.writes("events", "the isolated peaks found")
STAGE.option("preset", str, "which of the settings below to use", choices=["default", "coordinates", "paper"])
STAGE.option("default", mapping, "settings of the preset `default`: against the neighbours, all axes together")
STAGE.option(
    "coordinates", mapping, "settings of the preset `coordinates`: coordinate by coordinate, with robust thresholds"
)
STAGE.option("paper", mapping, "settings of the preset `paper`: as published (skurowski2022)")
STAGE.option("local_ridge", mapping, "settings of the predictor")


def work(call):
    recording, scene, earlier = detection.read(call.markers, call.mesh, call.earlier)
    found = peaks.detect_peaks(
        scene,
        markers=recording.markers,
        earlier=earlier,
        settings=peaks.settings(call.options),
        predictor=LocalRidge(RidgeOptions(**call.options["local_ridge"])),
    )
    storage.write_events(call.events, found, call.facts)
    return detection.result(found)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
