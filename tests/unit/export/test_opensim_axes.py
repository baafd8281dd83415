"""The axes of a file for OpenSim: y up, right-handed, from what the file states, an option, or the markers."""

import numpy as np
import pytest

from markermend.export.opensim_axes import DIRECTIONS, OpenSimAxes, choose_axes

FORWARD, UP, RIGHT = np.eye(3)


def body(up: str, *, floor: float = 20.0, height: float = 1700.0, frames: int = 50) -> np.ndarray:
    """Markers of a body that stands along a direction on a floor at zero, and moves 2 m across it."""
    rng = np.random.default_rng(4)
    axis, sign = "XYZ".index(up[1]), 1 if up[0] == "+" else -1
    positions = np.tile(rng.uniform(-200, 200, (12, 3)), (frames, 1, 1))
    positions[..., axis] = sign * np.linspace(floor, height, 12)
    positions[..., (axis + 1) % 3] += np.linspace(-1000, 1000, frames)[:, None]
    return positions


@pytest.mark.parametrize("vertical", DIRECTIONS)
def test_the_option_decides_and_what_is_up_becomes_y(vertical: str) -> None:
    axes = choose_axes(body("+Z"), screen=("+X", "+Y"), vertical=vertical)
    assert axes.y == vertical and "trc_vertical_axis" in axes.reason
    assert_right_handed(axes)


def assert_right_handed(axes: OpenSimAxes) -> None:
    turned = axes.turned(np.eye(3))
    assert np.linalg.det(turned) == 1.0
    np.testing.assert_array_equal(turned @ turned.T, np.eye(3))


def test_z_up_is_turned_about_x_as_is_usual() -> None:
    axes = choose_axes(body("+Z"), screen=None, vertical="auto")
    assert (axes.x, axes.y, axes.z) == ("+X", "+Z", "-Y")
    np.testing.assert_array_equal(axes.turned(np.array([[1.0, 2.0, 3.0], [0.0, 0.0, 0.0]])), [[1, 3, -2], [0, 0, 0]])
    assert not np.signbit(axes.turned(np.zeros((1, 3)))).any()
    assert np.isnan(axes.turned(np.full((1, 3), np.nan))).all()


@pytest.mark.parametrize(
    ("screen", "z"), [(("+X", "+Z"), "-Y"), (("+Y", "+Z"), "+X"), (("-Y", "+Z"), "-X"), (("-X", "+Z"), "+Y")]
)
def test_what_the_file_states_is_what_one_sees(screen: tuple[str, str], z: str) -> None:
    axes = choose_axes(body("+Z"), screen=screen, vertical="auto")
    assert (axes.x, axes.y, axes.z, axes.reason) == (*screen, z, "as the file states")
    assert_right_handed(axes)


def test_a_stated_direction_that_the_markers_do_not_follow_holds_unless_it_is_upside_down() -> None:
    assert choose_axes(body("+Z"), screen=("+X", "+Y"), vertical="auto").y == "+Y"
    turned_over = choose_axes(body("+Z"), screen=("-X", "-Z"), vertical="auto")
    assert (turned_over.x, turned_over.y) == ("+X", "+Z") and "states -Z" in turned_over.reason


@pytest.mark.parametrize("up", ["+Y", "-Y", "+X", "-X", "-Z"])
def test_where_nothing_is_stated_the_markers_may_show_what_is_up(up: str) -> None:
    axes = choose_axes(body(up), screen=None, vertical="auto")
    assert axes.y == up and "stand upright along it" in axes.reason


@pytest.mark.parametrize(
    "positions",
    [
        body("+Y", height=500.0),
        body("+Y", floor=900.0, height=2500.0),
        body("+Y")[:, :1],
        np.full((5, 3, 3), np.nan),
        np.empty((0, 3, 3)),
        np.empty((0, 0, 3)),
    ],
)
def test_z_is_assumed_to_be_up_where_nothing_shows_it(positions: np.ndarray) -> None:
    positions = np.where(np.arange(3) == 2, positions - 5000, positions)
    axes = choose_axes(positions, screen=None, vertical="auto")
    assert axes.y == "+Z" and axes.reason.startswith("assumed")
