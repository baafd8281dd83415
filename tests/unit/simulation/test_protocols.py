"""Artifacts one at a time distort the share that is asked for; practice brings every form of artifact."""

import numpy as np
import pytest

from markermend.core import artifacts as core_artifacts
from markermend.core import events
from markermend.simulation.protocols import in_practice, one_at_a_time
from support.contaminations import FRAMES, MARKERS, masks, paper, still


@pytest.mark.parametrize("share", [0.05, 0.1, 0.2])
def test_one_at_a_time_distorts_the_share(share):
    result = one_at_a_time(still(), MARKERS, recipes=paper(), share=share, margin=2, rng=np.random.default_rng(7))
    found = masks(result, FRAMES)
    distorted = sum(mask.sum(axis=1) for mask in found.values())
    assert distorted.max() == 1
    assert not any(found.pop(kind).any() for kind in ("labels", "frames", "frozen", "tails"))
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


def test_amplitudes_are_normal():
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


def test_equal_seeds_give_equal_contamination():
    one, two = (
        one_at_a_time(still(), MARKERS, recipes=paper(), share=0.1, margin=2, rng=np.random.default_rng(4))
        for _ in range(2)
    )
    assert np.array_equal(one.positions, two.positions)
    assert one.artifacts == two.artifacts


@pytest.fixture(scope="module")
def practice(walker):
    clean = walker.recording
    given = {"rate": clean.rate, "amplitude": 15.0, "share": 0.6, "rng": np.random.default_rng(11)}
    return in_practice(clean.positions, clean.markers, **given)


def test_contamination_in_practice_is_of_every_kind(practice):
    one_marker = [kind for kind in core_artifacts.DETECTORS if kind != "frames"]
    assert all(practice.events[kind] for kind in one_marker)
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


def test_contamination_in_practice_is_where_it_says(walker, practice):
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
