"""The activities of high dynamics: running has flight, punches come back, and who falls lies and stands up again."""

import numpy as np
import pytest

from markermend.numerics.intervals import runs
from support.walkers import acceleration, marker, person, speed


def bout(walker, name, *, inside=0.8):
    start, stop = next(bout[1:] for bout in walker.bouts if bout[0] == name)
    return slice(round((start + inside) * 100), round((stop - inside) * 100))


@pytest.mark.parametrize("seed", range(3))
def test_running_is_faster_than_walking(seed):
    walker = person(seed, duration=9.0, activities=["stand", "run", "walk"])
    running, walking = bout(walker, "run"), bout(walker, "walk")
    assert 2.0 < np.median(speed(walker, "LASI")[running]) < 3.3
    assert speed(walker, "LTOE")[running].max() > speed(walker, "LTOE")[walking].max()
    assert acceleration(walker, "LFHD")[running].max() < 30


@pytest.mark.parametrize("seed", range(3))
def test_in_flight_the_body_falls_freely_and_on_the_ground_it_is_pushed_up(seed):
    walker = person(seed, duration=5.0, activities=["run"], soft_tissue=0.0)
    pelvis = np.mean([marker(walker, name) for name in ("LASI", "RASI", "LPSI", "RPSI")], axis=0)
    vertical = np.gradient(np.gradient(pelvis[:, 2], 0.01), 0.01)[bout(walker, "run")] / 1000
    assert vertical.min() == pytest.approx(-9.81, abs=0.5)
    assert vertical.max() > 5
    flights = [stop - start for start, stop in runs(vertical < -8)]
    assert len(flights) >= 3
    assert max(flights) < 15


@pytest.mark.parametrize("seed", range(3))
def test_a_boxer_stays_and_punches_with_both_fists(seed):
    walker = person(seed, duration=12.0, activities=["box"])
    rows = bout(walker, "box")
    assert np.ptp(marker(walker, "LASI")[rows], axis=0).max() < 300
    for side in "LR":
        fist = speed(walker, f"{side}FIN")
        assert 3.0 < fist.max() < 10.0
        reach = np.linalg.norm(marker(walker, f"{side}FIN") - marker(walker, f"{side}SHO"), axis=1)
        assert reach.max() - np.median(reach) > 150


@pytest.mark.parametrize("seed", range(3))
def test_who_falls_hits_the_ground_lies_still_and_stands_up(seed):
    walker = person(seed, duration=10.0, activities=["stand", "fall", "stand"])
    height = marker(walker, "LFHD")[:, 2]
    lying = list(runs(height < 350))
    assert len(lying) == 1
    start, stop = lying[0]
    assert 100 < stop - start < 300
    assert height[:50].mean() - height[start:stop].min() > 1200
    assert acceleration(walker, "LFHD")[start - 20 : start + 30].max() > 25
    assert speed(walker, "LASI")[start + 60 : stop - 60].max() < 0.15
    assert abs(height[-50:].mean() - height[:50].mean()) < 40
    assert marker(walker, "LASI")[start:stop, 2].max() < 350
