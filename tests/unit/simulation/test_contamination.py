"""Contamination: the positions differ from the clean ones exactly where the truth says so."""

from itertools import pairwise

import numpy as np
import pytest

from markermend.core import artifacts as core_artifacts
from markermend.core import events
from markermend.simulation.artifact_models import SHAPES, Recipe, integers, normal, poisson, shape, uniform
from markermend.simulation.contamination import Contamination
from markermend.simulation.protocols import in_practice, one_at_a_time

FRAMES, MARKERS = 13000, [f"M{m}" for m in range(6)]


def still(frames=FRAMES):
    """Markers that stand still, 100 mm apart."""
    return np.zeros((frames, 6, 3)) + np.arange(6)[:, None] * 100.0


def paper(amplitude=5.0, mean_length=50.0):
    bulk = Recipe(normal(amplitude, 0.4 * amplitude), poisson(mean_length), 1)
    return {"peaks": Recipe(bulk.amplitude, integers(1, 5), 1), "noise": bulk, "steps": bulk, "slow": bulk}


def masks(contamination, frames):
    found = contamination.events
    return {kind: events.mask(found[kind], frames, contamination.markers) for kind in found}


def test_truth_is_exact(contaminated):
    clean, damaged = contaminated.clean.positions, contaminated.recording.positions
    shape = (len(clean), contaminated.clean.markers)
    artifacts = sum(events.mask(found, *shape).astype(int) for found in contaminated.events.values())
    missing = events.mask([events.Event(marker, start, stop, 1.0) for marker, start, stop in contaminated.gaps], *shape)
    assert (artifacts + missing).max() == 1
    assert np.array_equal(np.isnan(damaged).all(axis=2), missing)
    assert np.array_equal(np.isnan(damaged).any(axis=2), missing)
    assert np.array_equal((damaged != clean).any(axis=2), (artifacts == 1) | missing)
    assert {kind: len(found) for kind, found in contaminated.events.items()} == {
        "labels": 4, "frozen": 0, "peaks": 10, "noise": 4, "steps": 4, "slow": 4, "tails": 0,
    }  # fmt: skip


def test_axes_are_those_that_changed(contaminated):
    index = {marker: m for m, marker in enumerate(contaminated.clean.markers)}
    change = contaminated.recording.positions != contaminated.clean.positions
    for event in [event for found in contaminated.events.values() for event in found if not event.partner]:
        hit = change[event.start : event.stop, index[event.marker]].any(axis=0)
        assert event.axes == "".join(axis for axis, seen in zip("xyz", hit, strict=True) if seen)


def test_swapped_markers_stand_in_each_others_place(contaminated):
    index = {marker: m for m, marker in enumerate(contaminated.clean.markers)}
    swaps = contaminated.events["labels"]
    assert len(swaps) == 4
    for event in swaps:
        span, mine, other = slice(event.start, event.stop), index[event.marker], index[event.partner]
        here, there = contaminated.recording.positions[span, mine], contaminated.clean.positions[span, other]
        assert np.array_equal(here, there)
        assert any(back.partner == event.marker and back.start == event.start for back in swaps)


def test_gaps_of_every_kind(contaminated):
    gaps, frames = contaminated.gaps, contaminated.clean.frames
    assert any(start == 0 for _, start, _ in gaps)
    assert any(stop == frames for _, _, stop in gaps)
    together: dict[tuple[int, int], set[str]] = {}
    for marker, start, stop in gaps:
        together.setdefault((start, stop), set()).add(marker)
    assert {"LFIN", "LIDX", "LPKY"} in together.values()
    assert sum(len(markers) == 3 for markers in together.values()) == 2


@pytest.mark.parametrize("kind", SHAPES)
def test_shapes(kind):
    for length in (1, 2, 5, 50):
        course = shape(kind, length)
        assert course.max() == 1
        assert course.min() > 0
        if kind == "tails":
            assert (np.diff(course) > 0).all()
        else:
            np.testing.assert_allclose(course, course[::-1])
    if kind == "slow":
        assert np.ptp(np.diff(course)[:24]) < 1e-12


def test_amplitudes_come_back_from_the_positions():
    clean = still()
    damage = Contamination(clean, MARKERS, margin=5, one_at_a_time=False, rng=np.random.default_rng(3))
    for kind, axes in (("peaks", 1), ("steps", 2), ("slow", 3), ("noise", 1)):
        damage.add(kind, Recipe(uniform(8.0, 12.0), integers(300, 400), axes), count=4)
    for artifact in damage.artifacts:
        change = (damage.positions - clean)[artifact.start : artifact.stop, MARKERS.index(artifact.marker)]
        size = np.linalg.norm(artifact.amplitude)
        assert 8 <= size <= 12
        if artifact.kind == "noise":
            assert change.std(axis=0).max() == pytest.approx(size, rel=0.15)
        else:
            assert np.linalg.norm(change, axis=1).max() == pytest.approx(size)
    assert {len(event.axes) for event in damage.events["steps"]} == {2}
    assert not (clean - still()).any()


@pytest.mark.parametrize("share", [0.05, 0.1, 0.2])
def test_the_papers_protocol(share):
    result = one_at_a_time(still(), MARKERS, recipes=paper(), share=share, margin=2, rng=np.random.default_rng(7))
    found = masks(result, FRAMES)
    distorted = sum(mask.sum(axis=1) for mask in found.values())
    assert distorted.max() == 1
    assert not any(found.pop(kind).any() for kind in ("labels", "frozen", "tails"))
    for mask in found.values():
        assert mask.sum() == pytest.approx(share / 4 * FRAMES, abs=26)
    assert np.array_equal((result.positions != still()).any(axis=(1, 2)), distorted > 0)
    bulk = [artifact for artifact in result.artifacts if artifact.kind != "peaks"]
    lengths = np.array([artifact.stop - artifact.start for artifact in bulk])
    assert abs(lengths.mean() - 50) < 3 * np.sqrt(50 / len(lengths))


@pytest.mark.parametrize("frames", [340, 810])
def test_no_class_is_left_out_of_short_recordings(frames):
    """Where there is room for less than one, it is put in by chance, so that on average there is as much as asked."""
    counts = {kind: 0 for kind in paper()}
    for seed in range(300):
        rng = np.random.default_rng(seed)
        result = one_at_a_time(still(frames), MARKERS, recipes=paper(), share=0.1, margin=2, rng=rng)
        for kind, mask in masks(result, frames).items():
            counts[kind] = counts.get(kind, 0) + mask.sum()
    for kind in paper():
        assert counts[kind] / 300 == pytest.approx(0.1 / 4 * frames, rel=0.3)


def test_the_papers_amplitudes():
    rng = np.random.default_rng(1)
    recipes = {"steps": paper(10.0)["steps"]}
    sizes = np.array(
        [
            sum(artifact.amplitude)
            for _ in range(6)
            for artifact in one_at_a_time(still(), MARKERS, recipes=recipes, share=0.2, margin=0, rng=rng).artifacts
        ]
    )
    assert np.abs(sizes).mean() == pytest.approx(10, abs=0.8)
    assert np.abs(sizes).std() == pytest.approx(4, abs=0.6)
    assert (sizes > 0).mean() == pytest.approx(0.5, abs=0.1)


def test_equal_seeds_give_equal_damage():
    one, two = (
        one_at_a_time(still(), MARKERS, recipes=paper(), share=0.1, margin=2, rng=np.random.default_rng(4))
        for _ in range(2)
    )
    assert np.array_equal(one.positions, two.positions)
    assert one.artifacts == two.artifacts


def test_margin_is_kept_and_missing_samples_are_left_alone():
    clean = still(2000)
    clean[500:900, 2] = np.nan
    damage = Contamination(clean, MARKERS, margin=20, one_at_a_time=False, rng=np.random.default_rng(9))
    damage.add("steps", Recipe(uniform(8.0, 12.0), integers(30, 60), 3), count=60)
    assert np.array_equal(np.isnan(damage.positions), np.isnan(clean))
    for marker in MARKERS:
        spans = sorted((a.start, a.stop) for a in damage.artifacts if a.marker == marker)
        if marker == "M2":
            spans = sorted([*spans, (500, 900)])
        assert spans[0][0] >= 20
        assert spans[-1][1] <= 1980
        assert all(b[0] - a[1] >= 20 for a, b in pairwise(spans))


def test_no_room_is_an_error():
    damage = Contamination(still(200), MARKERS, margin=0, one_at_a_time=True, rng=np.random.default_rng(0))
    with pytest.raises(ValueError, match="no room"):
        damage.add("steps", Recipe(uniform(8.0, 12.0), integers(90, 90), 1), count=3)
    with pytest.raises(ValueError, match="within 50"):
        damage.swap(length=integers(5, 5), within_mm=50.0, count=1)
    with pytest.raises(ValueError, match="do not fit"):
        damage.gap(length=integers(201, 201), markers=1, at="anywhere", count=1)
    with pytest.raises(ValueError, match="cannot be distorted"):
        one_at_a_time(still(300), MARKERS, recipes=paper(), share=0.9, margin=40, rng=np.random.default_rng(0))


@pytest.fixture(scope="module")
def practice(walker):
    clean = walker.recording
    given = {"rate": clean.rate, "amplitude": 15.0, "share": 0.6, "rng": np.random.default_rng(11)}
    return in_practice(clean.positions, clean.markers, **given)


def test_damage_in_practice_is_of_every_kind(practice):
    assert all(practice.events[kind] for kind in core_artifacts.CLASSES)
    assert {len(artifact.event.axes) for artifact in practice.artifacts} == {1, 2, 3}
    forms = {(artifact.kind, artifact.form) for artifact in practice.artifacts}
    bulk = ("peaks", "noise", "steps", "slow")
    assert forms >= {
        (kind, form) for kind in bulk for form in ("alone", "together", "combined", "beside a gap", "at an end")
    }
    assert forms - {(kind, form) for kind in bulk for form in ("alone", "together", "combined", "beside a gap", "at an end")} == {
        ("peaks", "burst"), ("labels", "2 markers"), ("labels", "3 markers"), ("labels", "for good"),
        ("frozen", "alone"), ("tails", "beside a gap"),
    }  # fmt: skip


def of_form(practice, form):
    """The artifacts that were put in so, by marker and start."""
    chosen = [artifact for artifact in practice.artifacts if artifact.form == form]
    assert chosen
    return sorted(chosen, key=lambda artifact: (artifact.kind, artifact.start, artifact.marker))


def test_every_form_is_what_it_is_called(walker, practice):
    frames, lost = walker.recording.frames, np.isnan(practice.positions).any(axis=2)
    assert all(artifact.start == 0 or artifact.stop == frames for artifact in of_form(practice, "at an end"))
    assert all(artifact.stop == frames for artifact in of_form(practice, "for good"))
    for artifact in of_form(practice, "beside a gap"):
        own = lost[:, practice.markers.index(artifact.marker)]
        assert own[artifact.start - 1] != own[artifact.stop]
    together = [(artifact.kind, artifact.start, artifact.stop) for artifact in of_form(practice, "together")]
    assert {together.count(one) for one in together} == {3}
    names = [artifact.marker for artifact in of_form(practice, "burst")]
    assert min(names.count(name) for name in names) >= 3
    combined = of_form(practice, "combined")
    for over in (artifact for artifact in combined if artifact.kind in ("peaks", "noise")):
        assert any(
            under.kind in ("slow", "steps") and under.start <= over.start and over.stop <= under.stop
            for under in combined
            if under.marker == over.marker
        )


@pytest.mark.parametrize(("form", "length"), [("2 markers", 2), ("3 markers", 3), ("for good", 2)])
def test_the_samples_of_a_swapped_marker_are_its_partners(walker, practice, form, length):
    """And from partner to partner one comes back to the first."""
    clean, swapped = walker.recording.positions, of_form(practice, form)
    for artifact in swapped:
        span, ring = slice(artifact.start, artifact.stop), [artifact.marker]
        other = practice.markers.index(artifact.partner)
        assert np.array_equal(practice.positions[span, other], clean[span, practice.markers.index(artifact.marker)])
        onward = {
            one.marker: one.partner for one in swapped if (one.start, one.stop) == (artifact.start, artifact.stop)
        }
        while onward[ring[-1]] != artifact.marker:
            ring.append(onward[ring[-1]])
        assert len(ring) == length


def test_damage_in_practice_is_where_it_says(walker, practice):
    clean = walker.recording.positions
    covered = sum(events.mask(own, len(clean), practice.markers).astype(int) for own in practice.events.values())
    gaps = events.mask([events.Event(*gap, 1.0) for gap in practice.gaps], len(clean), practice.markers)
    combined = [artifact.event for artifact in practice.artifacts if artifact.form == "combined"]
    alone = ~events.mask(combined, len(clean), practice.markers)
    assert covered[alone].max() == 1 and covered.max() == 2
    assert not (gaps & (covered > 0)).any()
    assert np.array_equal(np.isnan(practice.positions).any(axis=2), gaps)
    assert np.array_equal((practice.positions != clean).any(axis=2), (covered > 0) | gaps)


def test_frozen_markers_repeat_and_tails_wander_off_towards_their_gaps(walker, practice):
    for event in practice.events["frozen"]:
        m = practice.markers.index(event.marker)
        held = practice.positions[event.start - 1 : event.stop, m]
        assert (held == held[0]).all()
        assert np.linalg.norm(walker.recording.positions[event.stop - 1, m] - held[0]) > 15
    size = 0
    for event in practice.events["tails"]:
        m = practice.markers.index(event.marker)
        away = np.linalg.norm((practice.positions - walker.recording.positions)[event.start : event.stop, m], axis=1)
        before, after = (np.isnan(practice.positions[frame, m]).all() for frame in (event.start - 1, event.stop))
        assert before != after
        size += (away[-1] - away[0]) * (1 if after else -1)
    assert size > 0
