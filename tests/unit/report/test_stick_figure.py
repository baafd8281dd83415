"""The stick figure: which poses a page holds, within its bound, which lines it draws, and which way is up."""

import numpy as np

from markermend.core.changes import Change, Outcome
from markermend.core.mesh import Mesh, Segment
from markermend.core.recording import FILLED, MISSING, Recording, Restored
from markermend.report import stick_figure as module
from markermend.report.stick_figure import chosen_rows, edges, stick_figure, upward_axis


def segment(name, markers, parent=None, parent_marker=None):
    return Segment(name, tuple(markers), 1.0, parent, parent_marker, None, 0, 1.0)


def mesh(*segments):
    markers = tuple(sorted(marker for own in segments for marker in own.markers))
    nobody = dict.fromkeys(markers, ())
    return Mesh(("r",), markers, segments, nobody, nobody)


def still(places, frames=4, rate=100.0):
    positions = np.repeat(np.array(list(places.values()), float)[None], frames, axis=0)
    return Recording(tuple(places), positions, rate, 101)


def drawn(recording, body):
    return {frozenset(recording.markers[m] for m in edge) for edge in edges(recording, body)}


def test_segments_are_connected_within_and_to_the_nearest_marker_of_their_parent():
    recording = still(
        {"A": (0, 0, 0), "B": (1, 0, 0), "C": (0, 1, 0), "D": (5, 0, 0), "E": (3, 0, 0), "loose": (9, 9, 9)}
    )
    body = mesh(segment("trunk", "ABC"), segment("arm", "DE", 0, "B"))
    assert drawn(recording, body) == set(map(frozenset, ("AB", "AC", "BC", "DE", "BE")))


def test_many_markers_of_a_segment_are_connected_by_the_shortest_tree():
    recording = still({name: (10 * place, 0, 0) for place, name in enumerate("ABCDE")})
    assert drawn(recording, mesh(segment("spine", "ABCDE"))) == set(map(frozenset, ("AB", "BC", "CD", "DE")))


def test_markers_that_the_recording_lacks_are_not_drawn():
    recording = still({"A": (0, 0, 0), "B": (1, 0, 0)})
    body = mesh(segment("trunk", "AX"), segment("arm", "B", 0, "X"), segment("head", "Y", 0, "A"))
    assert edges(recording, body) == []


def test_poses_are_all_of_a_short_recording_and_few_of_a_long_one(monkeypatch):
    monkeypatch.setattr(module, "POSITIONS", 100)
    monkeypatch.setattr(module, "REGULAR_POSITIONS", 40)
    short = Recording(("A", "B"), np.zeros((20, 2, 3)), 10.0)
    assert chosen_rows(short, [], context_s=0.2) == (1, list(range(20)))
    long = Recording(("A", "B"), np.zeros((1000, 2, 3)), 10.0)
    findings = [Change("A", 401, 404, ("peak",), Outcome.LEFT), Change("A", 700, 900, ("peak",), Outcome.LEFT)]
    step, rows = chosen_rows(long, findings, context_s=0.3)
    assert step == 50 and set(range(0, 1000, 50)) <= set(rows) and len(rows) * 2 <= 100
    assert {398, 399, 400, 401, 402, 403, 404, 405, 406, 799} <= set(rows)
    many = [Change("A", n, n + 1, ("peak",), Outcome.LEFT) for n in range(1, 1000, 2)]
    assert len(chosen_rows(long, many, context_s=0.3)[1]) * 2 == 100


def test_the_figure_holds_what_was_measured_and_what_became_of_it():
    positions = np.arange(24.0).reshape(4, 2, 3)
    positions[1, 0] = np.nan
    before = Recording(("A", "B"), positions, 100.0, 101)
    after = positions.copy()
    after[1, 0] = (3.4, 4.6, 5.0)
    after[3, 1] = np.nan
    origin = np.zeros((4, 2), np.uint8)
    origin[1, 0], origin[3, 1] = FILLED, MISSING
    restored = Restored(("A", "B"), after, 100.0, 101, {}, origin, np.zeros((4, 2)), np.zeros((4, 2)))
    figure = stick_figure(before, restored, mesh(segment("all", "AB")), [], context_s=0.5)
    assert (figure["frames"], figure["regular"], figure["edges"]) == ([101, 1, 1, 1], 1, [(0, 1)])
    assert figure["before"][0] == [[0, [0], [1], [2]], [2, [12, 6], [13, 6], [14, 6]]]
    assert figure["after"] == [[[1, [3], [5], [5]]], []]
    assert figure["taken"] == [[], [[3, 4]]]


def test_up_is_the_axis_along_which_the_markers_extend_furthest():
    standing = np.array([[[0, 0, 0], [300, 200, 1700]]], float)
    assert upward_axis(standing) == "z"
    assert upward_axis(standing[..., [0, 2, 1]]) == "y"
    assert upward_axis(np.full((3, 2, 3), np.nan)) == "z"
    assert upward_axis(np.zeros((3, 1, 3))) == "z"
