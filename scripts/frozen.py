"""Detect frozen markers: positions that repeat exactly while the neighbours move on.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_frozen.parquet.
"""

from markermend.command import detector
from markermend.detection.frozen import detect_frozen
from markermend.options.detection import FrozenOptions

STAGE = detector.unmeasured_stage("frozen", __doc__, finds="frozen stretches")
STAGE.option("frames", int, "frames with the same position, at least")
STAGE.option("neighbours", int, "the nearest neighbours, which must move meanwhile")
STAGE.option("floor_mm", float, "by how much they, and the marker by what they tell, must have moved, mm")
STAGE.option("sigmas", float, "and the marker by so many standard deviations of the prediction")


def work(call):
    return detector.search(call, detect_frozen, FrozenOptions)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
