"""Models in the frame of three references against the paper's formulas, frame by frame."""

from dataclasses import replace

import numpy as np

from markermend.prediction.reference_triangle import (
    LocalInterpolation,
    _Case,
    kernel_regression,
    quadratic_regression,
    triangle,
)
from support.fillings import predictor, rigid_body, scene


def naive_frame(points):
    """tits2018 eq 4-7 for one frame."""
    first = points[1] - points[0]
    u1 = first / np.linalg.norm(first)
    second = np.cross(first, points[2] - points[0])
    u2 = second / np.linalg.norm(second)
    return np.column_stack([u1, u2, np.cross(u1, u2)])


def naive_grnn(inputs, target, wanted, s):
    """tits2018 eq 15."""
    out = []
    for x in wanted:
        weight = np.array([np.exp(-((x - known) ** 2).sum() / (2 * s**2)) for known in inputs])
        out.append((weight[:, None] * target).sum(axis=0) / weight.sum())
    return np.array(out)


def test_the_frame_is_that_of_the_paper():
    points = rigid_body(frames=20, markers=3)
    found = triangle(points)
    for frame in range(20):
        axes = naive_frame(points[frame])
        assert np.allclose(found.frames.axes[frame], axes)
        local = (points[frame] - points[frame, 0]) @ axes
        assert np.allclose(local[1], [found.shape[frame, 0], 0, 0], atol=1e-9)
        assert np.allclose(local[2], [found.shape[frame, 1], 0, found.shape[frame, 2]], atol=1e-9)
    assert np.allclose(found.frames.laboratory(found.frames.local(points[:, 2])), points[:, 2])


def test_grnn_equals_its_formula():
    rng = np.random.default_rng(1)
    inputs, target, wanted = rng.normal(size=(40, 3)), rng.normal(size=(40, 3)), rng.normal(size=(7, 3))
    assert np.allclose(kernel_regression(inputs, target, wanted, width=0.3), naive_grnn(inputs, target, wanted, 0.3))


def test_grnn_far_from_all_training_gives_the_nearest():
    inputs, target = np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[5.0, 5, 5], [7, 7, 7]])
    assert np.allclose(kernel_regression(inputs, target, np.array([[90.0, 0, 0]]), width=0.3), 7)


def test_quadratic_regression_finds_a_quadratic_exactly():
    rng = np.random.default_rng(2)
    inputs, wanted = rng.normal(size=(80, 3)), rng.normal(size=(9, 3))

    def truth(x):
        return np.stack([1 + x[:, 0] * x[:, 1], x[:, 2] ** 2 - 3 * x[:, 0], 2 + x.sum(axis=1)], axis=1)

    assert np.allclose(quadratic_regression(inputs, truth(inputs), wanted, ridge=0.0), truth(wanted))


def test_local_interpolation_is_straight_in_the_frame(walker):
    positions = walker.recording.positions[:500]
    seen = scene(positions)
    model = predictor("local_interpolation")
    found = model.predict(seen, 7, 200, 260).positions
    cases = (_Case(seen, 7, triple, seen.present[:, 7], 200, 260) for triple in model._triples(seen, 7))
    triple = next(case.references for case in cases if len(model._training(case)))
    local = triangle(positions[199:261][:, triple]).frames.local(found)
    share = np.linspace(0, 1, 62)[:, None]
    assert np.allclose(local, local[0] + share * (local[-1] - local[0]), atol=1e-6)
    assert np.allclose(found[[0, -1]], positions[[199, 260], 7])


def test_references_on_a_line_are_passed_over():
    body = rigid_body(markers=5)
    middle = (body[:, 0] + body[:, 1]) / 2
    positions = np.concatenate([body[:, :2], middle[:, None], body[:, 2:]], axis=1)
    neighbours = [np.array([0, 1, 2, 3, 4]) for _ in range(6)]
    thin = type(scene(positions))(positions, 100.0, neighbours)
    found = predictor("local_interpolation").predict(thin, 5, 100, 150).positions
    assert np.abs(found - positions[99:151, 5]).max() < 1e-6


def test_three_references_are_needed():
    positions = rigid_body(markers=3)
    model = LocalInterpolation(replace(predictor("local_interpolation").options, min_height_mm=0.0))
    assert np.isnan(model.predict(scene(positions), 2, 100, 120).positions).all()


def test_the_local_ramp_meets_the_borders_and_is_straight_in_the_local_frame(walker):
    positions = walker.recording.positions[:400]
    seen = scene(positions).without(9, 200, 240)
    member = predictor("local_grnn")
    (references,) = [next(member._triples(seen, 9))]
    raw, met = member.predict(seen, 9, 199 + 1, 240).positions, member.predict_continuous(seen, 9, 200, 240).positions
    assert np.allclose(met[[0, -1]], positions[[199, 240], 9])
    offsets = []
    for n, frame in enumerate(range(199, 241)):
        offsets.append((raw[n] - met[n]) @ naive_frame(positions[frame, references]))
    offsets = np.array(offsets)
    share = np.linspace(0, 1, 42)[:, None]
    assert np.allclose(offsets, offsets[0] + share * (offsets[-1] - offsets[0]), atol=1e-9)
    assert np.abs(offsets).max() > 0.1


def test_the_local_ramp_is_constant_at_an_end_and_needs_the_references_at_the_borders(walker):
    positions = walker.recording.positions[:400].copy()
    member = predictor("local_quadratic")
    seen = scene(positions).without(9, 370, 400)
    met = member.predict_continuous(seen, 9, 370, 400).positions
    assert np.allclose(met[0], positions[369, 9]) and np.isfinite(met[:-1]).all()
    references = next(member._triples(seen, 9))
    hidden = seen.without(references[0], 369, 370)
    other = member.predict_continuous(hidden, 9, 370, 400).positions
    assert np.allclose(other[0], positions[369, 9]) and not np.allclose(other[5:-1], met[5:-1])


def test_smoothed_references_keep_noise_out_of_the_shape(walker):
    positions = walker.recording.positions[:400] + np.random.default_rng(5).normal(0, 1, (400, 51, 3))
    case = _Case(scene(positions), 9, np.array([3, 4, 10]), np.ones(400, bool), 100, 120)
    frames = np.arange(20, 380)
    true = triangle(walker.recording.positions[frames][:, [3, 4, 10]]).shape
    rough, smooth = case.triangle_at(frames).shape, case.smoothed_triangle_at(frames, 0.07).shape
    assert np.abs(smooth - true).mean() < 0.7 * np.abs(rough - true).mean()
    assert np.array_equal(case.smoothed_triangle_at(frames, 0.0).shape, rough)
