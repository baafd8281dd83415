"""Bodies are of human size, left and right equally."""

import numpy as np
import pytest

from markermend.simulation.walker_body import make_body


@pytest.mark.parametrize("seed", range(8))
def test_bodies_are_of_human_size(seed):
    body = make_body(rng=np.random.default_rng(seed))
    lengths = {name: np.linalg.norm(joint) for name, joint in zip(body.segments, body.joints, strict=True)}
    assert 1480 <= body.height <= 2000
    assert 320 < lengths["left_shank"] < 540
    assert 320 < lengths["right_foot"] < 540
    assert 240 < lengths["left_forearm"] < 420
    assert lengths["left_shank"] == lengths["right_shank"]
