"""The paper's contamination distorts as much as the printed errors of its distorted recordings say."""

from functools import cache

import numpy as np
import pytest

from markermend.simulation.published_contamination import CLASSES, contaminate_coordinates
from support.contaminations import MARKERS, still

FRAMES, COORDINATES = 3200, 159
"""Of the paper's recording: 53 markers, 32 s."""

PRINTED_MM = {
    ("peaks", 0.05): 0.19065, ("peaks", 0.1): 0.26906, ("peaks", 0.2): 0.38228,
    ("noise", 0.05): 0.17717, ("noise", 0.1): 0.26340, ("noise", 0.2): 0.39623,
    ("steps", 0.05): 0.18069, ("steps", 0.1): 0.26282, ("steps", 0.2): 0.39247,
    ("slow", 0.05): 0.10129, ("slow", 0.1): 0.15037, ("slow", 0.2): 0.21676,
}  # fmt: skip
"""Root mean square error of the distorted recordings, 10 mm, means of 200 runs (skurowski2022, Tables 3 to 5)."""

NOT_REPRODUCED = {("noise", 0.2), ("steps", 0.2)}
"""Printed 4 to 5 % above what the share and the amplitude give, though slow changes of the same process agree."""

PRINTED_RUNS = 200


def contaminate(frames=FRAMES, seed=0, **given):
    given = {"amplitude": 10.0, "share": 0.2, **given}
    return contaminate_coordinates(still(frames), MARKERS, rng=np.random.default_rng(seed), **given)


@cache
def errors_mm(kind, share):
    """Error of each run over as many coordinates as the paper had."""
    clean = still(FRAMES)[:, :1]
    found = []
    for seed in range(20 if kind == "peaks" else 600):
        given = {"amplitude": 10.0, "share": share, "rng": np.random.default_rng(seed)}
        distorted = contaminate_coordinates(clean, MARKERS[:1], kinds=[kind], **given).positions
        found.append(np.sqrt(((distorted - clean) ** 2).sum() / (FRAMES * COORDINATES)))
    return np.array(found)


@pytest.mark.parametrize(("kind", "share"), sorted(PRINTED_MM))
def test_the_errors_of_distorted_recordings_are_those_printed(kind, share):
    """Within 2 %, or within twice the standard error of what is printed."""
    printed = PRINTED_MM[kind, share]
    error = errors_mm(kind, share)
    tolerance = max(0.02 * printed, 2 * error.std() / np.sqrt(PRINTED_RUNS))
    if (kind, share) in NOT_REPRODUCED:
        assert printed > error.mean() + tolerance
        assert error.mean() == pytest.approx(printed, rel=0.06)
    else:
        assert error.mean() == pytest.approx(printed, abs=tolerance)


def test_the_errors_together_are_those_printed():
    """Over the shares and classes that agree, the mean ratio is 1 to 2 %."""
    ratios = [
        errors_mm(kind, share).mean() / printed
        for (kind, share), printed in PRINTED_MM.items()
        if (kind, share) not in NOT_REPRODUCED
    ]
    assert np.mean(ratios) == pytest.approx(1, abs=0.02)


@pytest.mark.parametrize("share", [0.05, 0.1, 0.2])
def test_each_class_distorts_the_share(share):
    samples = np.zeros(len(CLASSES))
    for seed in range(20):
        for artifact in contaminate(6400, seed, share=share).artifacts:
            samples[CLASSES.index(artifact.kind)] += artifact.stop - artifact.start
    assert samples / (20 * 6400) == pytest.approx(share, rel=0.15)


def test_one_coordinate_at_a_time():
    made = contaminate()
    distorted = made.positions != still(FRAMES)
    assert distorted.sum(axis=(1, 2)).max() == 1
    assert {artifact.event.axes for artifact in made.artifacts} == set("xyz")
    assert {artifact.marker for artifact in made.artifacts} == set(MARKERS)
    covered = np.zeros_like(distorted)
    for artifact in made.artifacts:
        covered[artifact.start : artifact.stop, MARKERS.index(artifact.marker), "xyz".index(artifact.event.axes)] = True
    assert (covered | ~distorted).all()


def test_each_class_has_its_shape():
    made = contaminate(64000)
    change = made.positions - still(64000)
    deviations = []
    for artifact in made.artifacts:
        m, axis = MARKERS.index(artifact.marker), "xyz".index(artifact.event.axes)
        own, size = change[artifact.start : artifact.stop, m, axis], artifact.amplitude[axis]
        if artifact.kind == "peaks":
            assert own == pytest.approx([size])
        elif artifact.kind == "steps":
            assert own == pytest.approx(size)
        elif artifact.kind == "slow":
            assert np.abs(own).max() == pytest.approx(abs(size))
            assert np.ptp(np.diff(own[: len(own) // 2])) < 1e-9 * max(1, abs(size))
            assert own == pytest.approx(own[::-1])
        elif len(own) > 30:
            deviations.append(own.std() / abs(size))
    assert np.mean(deviations) == pytest.approx(1, abs=0.03)


def test_lengths_amplitudes_and_signs():
    made = contaminate(200_000, share=0.1)
    bulk = [artifact for artifact in made.artifacts if artifact.kind != "peaks"]
    assert np.mean([artifact.stop - artifact.start for artifact in bulk]) == pytest.approx(50, abs=1.5)
    sizes = np.array([sum(artifact.amplitude) for artifact in made.artifacts if artifact.kind == "peaks"])
    assert np.abs(sizes).mean() == pytest.approx(10, abs=0.3)
    assert np.abs(sizes).std() == pytest.approx(4, abs=0.3)
    assert (sizes > 0).mean() == pytest.approx(0.5, abs=0.03)


def test_some_classes_only():
    assert {artifact.kind for artifact in contaminate(kinds=["steps", "peaks"]).artifacts} == {"steps", "peaks"}
    assert {artifact.kind for artifact in contaminate(kinds=["slow"]).artifacts} == {"slow"}


def test_missing_samples_are_left_alone():
    positions = still(FRAMES)
    positions[500:2500, 1] = np.nan
    made = contaminate_coordinates(positions, MARKERS, amplitude=10.0, share=0.2, rng=np.random.default_rng(3))
    assert np.array_equal(np.isnan(made.positions), np.isnan(positions))
    assert not any(a.marker == MARKERS[1] and a.stop > 500 and a.start < 2500 for a in made.artifacts)


def test_equal_seeds_give_equal_contamination():
    assert np.array_equal(contaminate(seed=4).positions, contaminate(seed=4).positions)
    assert not np.array_equal(contaminate(seed=4).positions, contaminate(seed=5).positions)


def test_what_cannot_be_done_is_refused():
    with pytest.raises(ValueError, match="no tails"):
        contaminate(kinds=["tails"])
    with pytest.raises(ValueError, match="no clean frames"):
        contaminate(share=0.25)
    with pytest.raises(ValueError, match="no marker is complete"):
        contaminate_coordinates(
            np.full((3200, 6, 3), np.nan), MARKERS, amplitude=10.0, share=0.2, rng=np.random.default_rng(0)
        )
