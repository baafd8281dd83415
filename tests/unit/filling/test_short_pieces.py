"""Short pieces between gaps: the stretches that hold them, and which of them are trusted."""

import numpy as np
import pytest

from markermend.filling.ensemble import Filling
from markermend.filling.gap import Gap
from markermend.filling.short_pieces import stretch_of, widened, without_doubtful_pieces
from support.fillings import rigid_body, scene


def naive_stretch(seen, gap, border):
    """Every frame that no run of `border` seen frames separates from the gap."""
    start, stop = gap.start, gap.stop
    while border and start > 0 and not (start >= border and seen[start - border : start].all()):
        start -= 1
    while border and stop < len(seen) and not (stop + border <= len(seen) and seen[stop : stop + border].all()):
        stop += 1
    return Gap(gap.marker, start, stop)


def test_a_stretch_ends_where_the_marker_is_seen_for_long_enough():
    rng = np.random.default_rng(5)
    for _ in range(200):
        seen = rng.random(40) < 0.7
        [first, *_] = np.flatnonzero(~seen)
        gap = Gap(0, int(first), int(first + np.argmax(np.append(seen, True)[first:])))
        for border in range(5):
            assert stretch_of(~seen[:, None], gap, border) == naive_stretch(seen, gap, border)


def seen_at(frames):
    """A scene in which marker 1 is hidden in [100, 120) but for some frames."""
    positions = rigid_body()
    positions[np.setdiff1d(np.arange(100, 120), frames), 1] = np.nan
    return scene(positions)


@pytest.mark.parametrize(("off", "hidden"), [(0.9, False), (1.1, True), (np.nan, True)])
def test_a_piece_is_hidden_whole_if_any_of_its_samples_is_away_from_its_prediction_or_has_none(off, hidden):
    shown = seen_at([104, 110, 111])
    asked = []

    def predict(bare, stretch):
        asked.append((stretch, bare.present[100:120, 1].any()))
        positions = rigid_body()[100:120, 1].copy()
        positions[11] += [3 * off, 0, 0]
        return Filling(positions, np.full(20, 1.5), {})

    stretch = Gap(1, 100, 120)
    found = without_doubtful_pieces(shown, [stretch, stretch], predict, radius=2.0)
    assert asked == [(stretch, False)]
    assert found.present[[104, 110, 111], 1].tolist() == [True, not hidden, not hidden]
    assert (found is shown) == (not hidden)
    assert widened(found, Gap(1, 105, 110)) == (Gap(1, 105, 120) if hidden else Gap(1, 105, 110))


def test_nothing_is_predicted_without_stretches():
    shown = seen_at([])
    assert without_doubtful_pieces(shown, [], None, radius=1.0) is shown
    assert widened(shown, Gap(1, 100, 120)) == Gap(1, 100, 120)


def test_a_gap_is_widened_to_the_ends_of_the_recording_where_nothing_else_is_seen():
    positions = rigid_body()
    positions[:, 2] = np.nan
    assert widened(scene(positions), Gap(2, 50, 60)) == Gap(2, 0, len(positions))
