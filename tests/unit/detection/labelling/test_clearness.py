"""How clearly distances show which labels are right, frame by frame and over a stretch."""

import numpy as np
import pytest

from markermend.detection.labelling.clearness import pair_clearness, stretch_clearness
from markermend.detection.labelling.permutations import Permutation
from markermend.prediction.scene import Scene
from support.exchanged import moving, scene
from support.naive import labels as naive


def test_the_shape_says_where_they_are_exchanged():
    clearness = pair_clearness(scene((40, 60)), (0, 1), neighbours=6)
    assert clearness[40:60].max() < -0.9 and np.delete(clearness, np.s_[40:60]).min() > 0.9
    gone = scene()
    gone.positions[10:20, :2] = np.nan
    assert not pair_clearness(gone, (0, 1), neighbours=6)[10:20].any()


@pytest.mark.parametrize("seed", range(4))
def test_the_shape_is_compared_distance_by_distance(seed):
    recorded, _ = moving(seed, frames=20)
    recorded[3:5, 0] = np.nan
    near = [np.delete(np.arange(6), m) for m in range(6)]
    labels = np.random.default_rng(seed).permutation([0, 1, 2]).tolist()
    found = stretch_clearness(Scene(recorded, 100.0, near), Permutation((0, 1, 2), tuple(labels)), 4, 12, neighbours=5)
    assert found == pytest.approx(naive.clearness(recorded, (0, 1, 2), labels, (3, 4, 5), 4, 12))
