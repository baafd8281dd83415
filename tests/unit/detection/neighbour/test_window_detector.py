"""What the detectors of residual windows share: what is new of some markers, and what stays of the recording."""

import numpy as np

from markermend.detection.peaks import PeakDetector
from markermend.prediction.scene import Scene
from support.residuals import PEAKS, rough


def test_an_update_is_a_measurement_of_some_markers_under_the_same_covariance():
    residual = np.stack([rough(200, seed) for seed in range(3)], axis=1)
    near = [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])]
    detector = PeakDetector(Scene(residual, 100.0, near), "ABC", PEAKS)
    before = detector.measure(residual)
    changed = residual.copy()
    changed[50:80] *= 40
    after = detector.update(before, changed, [1])
    assert after.covariance is before.covariance
    assert np.array_equal(after.misfit[:, [0, 2]], before.misfit[:, [0, 2]])
    assert not np.array_equal(after.misfit[:, 1], before.misfit[:, 1])
    again = detector.update(after, residual, [1])
    assert np.array_equal(again.misfit, before.misfit) and np.array_equal(again.local_scale, before.local_scale)


def test_the_trajectory_itself_is_judged_for_candidates_and_nothing_is_unexplained():
    residual = np.stack([rough(200, seed) for seed in range(2)], axis=1)
    residual[100:102, 1] += 9
    detector = PeakDetector(Scene(residual, 100.0, [np.array([1]), np.array([0])]), "AB", PEAKS)
    statistics = detector.measure(residual)
    assert detector.find_candidates(statistics, 0) == [] and detector.find_candidates(
        statistics, 1
    ) == detector.find_events(statistics, 1)
    assert [(event.marker, event.start, event.stop) for event in detector.find_events(statistics, 1)] == [
        ("B", 100, 102)
    ]
    assert detector.unexplained(statistics, 1) == ()
    assert detector.border == detector.window // 2
