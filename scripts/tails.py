"""Detect noisy tails: samples beside a gap that wander off.

Reads: 01_markers.parquet, mesh.json, the events of the detectors before.
Writes: 02_tails.parquet.
"""

from markermend.command import detector
from markermend.detection.tails import detect_tails
from markermend.options.detection import TailsOptions

STAGE = detector.unmeasured_stage("tails", __doc__, finds="noisy tails")
STAGE.option("longest_s", float, "longest tail, s")
STAGE.option("before_s", float, "how long the marker must be seen before that, further from the gap, s")
STAGE.option("activity_s", float, "time around over which the usual size of changes is taken, s")
STAGE.option("changes", float, "a tail begins with a change that exceeds the usual size by this factor")
STAGE.option("floor_mm", float, "how far from the prediction its worst sample must be, mm")
STAGE.option("sigmas", float, "and how far in standard deviations of the prediction")
STAGE.option("weak", float, "half of its samples must exceed this share of that (0 to 1)")


def work(call):
    return detector.search(call, detect_tails, TailsOptions)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
