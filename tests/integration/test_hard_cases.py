"""Hard gaps with the default ensemble: filled well, or left open with the true reason; what was measured never changes."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from markermend import api
from markermend.core.recording import FILLED, MISSING, Recording
from markermend.filling.fill import fill_gaps
from markermend.formats import files
from markermend.formats.ingest import ingest
from markermend.options.ingest import IngestOptions
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body
from support import bodies, fillings
from support.c3d_files import write
from support.fillings import restored, rigid_body
from support.treated import Treated, treated

TOO_BRIEF = (
    "not seen on both sides for long enough (advanced.fill.border_s: 0.02), nor rigid with 3 seen markers; without the short "
    "pieces: at the recording's start"
)

pytestmark = pytest.mark.filterwarnings("error")


class Outcome(NamedTuple):
    """A recording after filling: error of each filled sample, mm, shares inside error and error95, reasons by marker."""

    result: Treated
    distance: np.ndarray
    inside: float
    inside95: float
    left: dict[str, str]


def fill(whole, gaps, **options):
    """Make gaps (marker, start, stop), infer the mesh, fill, and check what must hold whatever happens."""
    positions = whole.positions.copy()
    for marker, start, stop in gaps:
        positions[start:stop, marker] = np.nan
    gapped = restored(positions, markers=whole.markers, rate=whole.rate)
    mesh = api.infer_mesh([gapped])
    result = treated(fillings.fill(gapped, mesh.neighbour_indices(whole.markers), **options))
    missing = gapped.missing
    assert np.array_equal(result.positions[~missing], positions[~missing])
    open_ = result.missing
    assert not (open_ & ~missing).any()
    assert (result.origin[missing & ~open_] == FILLED).all() and (result.origin[open_] == MISSING).all()
    for radius in (result.error, result.error95):
        assert (radius[missing & ~open_] > 0).all() and (radius[~missing] == 0).all() and np.isnan(radius[open_]).all()
    outcomes = result.fills + result.gaps_left
    assert sum(entry.stop - entry.start for entry in outcomes) == missing.sum()
    filled = missing & ~open_
    distance = np.linalg.norm((result.positions - whole.positions)[filled], axis=1)
    shares = [
        float(np.mean(distance <= radius[filled])) if filled.any() else 1.0 for radius in (result.error, result.error95)
    ]
    reasons = {entry.marker: entry.reason.text for entry in result.gaps_left}
    return Outcome(result, distance, *shares, reasons)


def joined(*recordings):
    """Recordings of equal length in one, their markers prefixed by number."""
    return Recording(
        tuple(f"{k}:{name}" for k, part in enumerate(recordings) for name in part.markers),
        np.concatenate([part.positions for part in recordings], axis=1),
        recordings[0].rate,
    )


def still(frames, markers):
    """Markers that never move by a bit."""
    places = np.random.default_rng(3).uniform(0, 400, (markers, 3))
    return bodies.recording([f"still{k}" for k in range(markers)], np.broadcast_to(places, (frames, markers, 3)))


@pytest.fixture(scope="module")
def person(walker):
    """The walker's recording: 12 s, 51 markers."""
    return walker.recording


@pytest.fixture(scope="module")
def chain():
    """A body of five segments of four markers, 15 s."""
    names, positions, _ = bodies.subject(4)
    noise = np.random.default_rng(1).normal(0, 0.2, positions.shape)
    return bodies.recording(names, positions + noise)


def first(recording, *, frames=None, markers=None):
    """The first frames and markers of a recording."""
    positions = recording.positions[:frames, :markers].copy()
    return replace(recording, positions=positions, markers=recording.markers[:markers])


def filled_well(done, *, gaps, error, inside95=0.8):
    """All gaps are filled, with a mean error below a bound in mm, and error95 holds the truth for at least a share of the samples."""
    assert done.left == {} and len(done.result.fills) == gaps
    assert done.distance.mean() < error
    assert done.inside95 >= inside95


def left_open(done, reason):
    """Nothing is filled, for one reason."""
    assert done.result.fills == []
    assert set(done.left.values()) == {reason}


def test_twenty_gaps_at_once(person):
    markers = np.random.default_rng(3).permutation(51)[:20]
    filled_well(fill(first(person, frames=800), [(m, 500, 550) for m in markers]), gaps=20, error=3)


@pytest.mark.parametrize(("segment", "error"), [("head", 12), ("left_forearm", 6), ("right_thigh", 2)])
def test_a_whole_segment(walker, segment, error):
    lost = [m for m, own in enumerate(walker.segments) if own == segment]
    places = 150, 350, 500, 750, 950
    done = fill(walker.recording, [(m, start, start + 50) for m in lost for start in places])
    assert all(reason.startswith("expected error") for reason in done.left.values())
    filled_well(done._replace(left={}), gaps=len(lost) * len(places) - len(done.result.gaps_left), error=error)
    assert len(done.left) <= len(places)


def test_a_limb_with_nothing_beyond_it(walker):
    lost = [m for m, own in enumerate(walker.segments) if own in ("right_shank", "right_foot")]
    done = fill(walker.recording, [(m, 500, 550) for m in lost])
    assert all(reason.startswith("expected error") for reason in done.left.values())
    filled = done.result.origin == FILLED
    assert (done.result.error95[filled] > 2).all()


def test_a_marker_and_its_ten_nearest(person):
    near = api.infer_mesh([person]).neighbour_indices(person.markers)[10][:10]
    done = fill(first(person, frames=800), [(m, 500, 530) for m in (10, *near)])
    filled_well(done, gaps=11, error=8, inside95=0.6)


def test_all_markers_lost(chain):
    few = first(chain, markers=8)
    filled_well(fill(few, [(m, 700, 706) for m in range(8)]), gaps=8, error=2)
    left_open(fill(few, [(m, 700, 790) for m in range(8)]), "no method could fill it; fewest neighbours seen: 0")
    done = fill(few, [(m, 700, 720) for m in range(8)], members=["spline", "kalman"])
    assert len(done.result.fills) >= 6 and done.distance.mean() < 30 and done.inside95 >= 0.5
    assert all(reason.startswith("expected error") for reason in done.left.values())


def test_a_marker_seen_rarely(chain):
    gaps = [(5, start, start + 75) for start in range(10, 1460, 100)]
    left_open(fill(chain, gaps), "marker seen in 25% of the frames (fill.min_seen_share: 0.3)")
    filled_well(fill(chain, gaps, min_seen_share=0.2), gaps=15, error=2)


def test_no_marker_complete(chain):
    done = fill(first(chain, markers=12, frames=1000), [(m, 100 + 60 * m, 180 + 60 * m) for m in range(12)])
    assert len(done.result.fills) >= 10
    assert all(reason.startswith("expected error") for reason in done.left.values())
    assert done.distance.mean() < 5 and done.inside95 > 0.9


def test_ends_only_on_request(chain):
    gaps = [(2, 0, 40), (9, 1460, 1500)]
    done = fill(chain, gaps)
    assert done.left == {"0c": "at the recording's start", "2b": "at the recording's end"}
    filled_well(fill(chain, gaps, fill_ends=True), gaps=2, error=2)


def test_all_markers_enter_and_leave(chain):
    ends = [(m, 0, 100 + m) for m in range(20)] + [(m, 1400 - m, 1500) for m in range(20)]
    done = fill(chain, [*ends, (4, 600, 650), (11, 800, 900)])
    assert len(done.result.fills) == 2 and len(done.result.gaps_left) == 40
    assert {entry.reason.text for entry in done.result.gaps_left} == {
        "at the recording's start",
        "at the recording's end",
    }
    assert done.distance.mean() < 1 and done.inside95 > 0.8


def test_other_subjects_are_not_used(chain):
    names, other, _ = bodies.subject(9, away=(2500.0, 0, 0))
    prop = Recording(tuple("abcde"), rigid_body(1500, 5), 100.0)
    both = joined(chain, bodies.recording(names, other), prop)
    own = [(3, 500, 560), (12, 900, 1000)]
    alone, together = fill(chain, own), fill(both, own)
    deserted = fill(both, own + [(m, 450, 1100) for m in range(20, 40)])
    assert set(deserted.left.values()) == {"gap of 6.50 s (fill.max_gap_s: 2)"}
    filled_well(alone, gaps=2, error=1)
    for done in (together, deserted):
        assert np.array_equal(done.result.positions[:, :20], alone.result.positions)
    filled_well(fill(both, [(41, 500, 560), (43, 520, 640)]), gaps=2, error=0.1)


def test_eight_markers(chain):
    filled_well(fill(first(chain, markers=8), [(2, 500, 560), (6, 530, 600)]), gaps=2, error=1)


def test_errors_do_not_depend_on_the_rate():
    errors = []
    for rate in (50.0, 250.0):
        rng = np.random.default_rng(8)
        body = make_body(rng=rng)
        bouts = ["reach", "walk"]
        whole = walk(
            body=body,
            duration=8.0,
            rate=rate,
            activities=bouts,
            errors=MeasurementErrors(noise=0.0, soft_tissue=1.0),
            rng=rng,
        ).recording
        gaps = [(m, int(begin * rate), int((begin + 0.5) * rate)) for m, begin in ((3, 2), (12, 2.2), (17, 5))]
        # Of five pseudo-gaps, those that happen to be drawn matter more to the weights than the rate; and more frames teach more.
        process = replace(fillings.predictor_options().local_gp, max_training_frames=350)
        predictors = replace(fillings.predictor_options(), local_gp=process)
        done = fill(first(whole, markers=20), gaps, averaging={"pseudo_gaps": 12}, predictors=predictors)
        filled_well(done, gaps=3, error=0.5)
        errors.append(done.distance.mean())
    assert errors[0] == pytest.approx(errors[1], rel=0.25)


def test_metres_and_millimetres_are_filled_equally(chain, tmp_path):
    positions = chain.positions.copy()
    positions[500:560, 3] = np.nan
    results = []
    for unit, size in (("mm", 1.0), ("m", 0.001)):
        path = write(tmp_path / f"{unit}.c3d", positions * size, labels=list(chain.markers), unit=unit)
        own = IngestOptions()
        reading = files.read(path, unlabelled=own.unlabelled, rate=None)
        whole = ingest(
            reading,
            source=path.name,
            recording="walk",
            subject="S1",
            kind="dynamic",
            options=own,
        )
        results.append(fill(whole, []).result)
    assert not any(result.missing.any() for result in results)
    # Reals of 32 bits round differently in the two units.
    assert np.abs(results[0].positions - results[1].positions).max() < 0.002
    assert np.allclose(results[0].error95, results[1].error95, atol=0.01)


@pytest.mark.parametrize(("frames", "gap"), [(3, (3, 1, 2)), (12, (3, 1, 2)), (50, (3, 20, 24))])
def test_few_frames(chain, frames, gap):
    done = fill(first(chain, frames=frames), [gap])
    if frames < 50:
        left_open(done, TOO_BRIEF)
    else:
        filled_well(done, gaps=1, error=3)


def test_what_never_moves(chain):
    done = fill(joined(chain, still(1500, 1)), [(20, 500, 560)])
    left_open(done, "no method could fill it; fewest neighbours seen: 0")
    together = joined(chain, still(1500, 4))
    filled_well(fill(together, [(20, 500, 560), (21, 620, 700), (3, 510, 580)]), gaps=3, error=0.5)
    assert np.abs(fill(still(1500, 5), [(2, 500, 560)]).distance).max() < 1e-6


@pytest.mark.parametrize("between", [1, 2])
def test_islands_of_a_sample_or_two(chain, between):
    gaps = [(9, start, start + 24) for start in range(600, 600 + 5 * (24 + between), 24 + between)]
    filled_well(fill(chain, gaps), gaps=5, error=2)
    if between == 1:
        long = [(9, start, start + 59) for start in range(600, 900, 60)]
        assert set(fill(chain, long).left) == {chain.markers[9]}


def test_a_ghost_between_gaps_does_not_bend_their_filling(chain):
    gaps = [(9, 600, 624), (9, 625, 640)]
    ghost = replace(chain, positions=chain.positions.copy())
    ghost.positions[624, 9] += [25.0, 0.0, 0.0]
    bent, checked = (fill(ghost, gaps, checked_piece_s=seconds, border_s=0.0) for seconds in (0.0, 0.05))
    assert bent.distance.max() > 10 and checked.distance.max() < 3


@pytest.mark.parametrize("piece", [1, 3])
def test_a_marker_of_a_rigid_plate_that_flickers(piece):
    """Two plates of four markers; one marker is seen in short pieces at entry and for 3 s, once 25 mm away."""
    names, positions, _ = bodies.subject(4, tree=(None, 0), frames=1000)
    plates = bodies.recording(names, positions + np.random.default_rng(1).normal(0, 0.2, positions.shape))
    hidden = np.r_[0:100, 400:700]
    hidden = hidden[hidden % 10 < 10 - piece]
    plates.positions[409, 1] += [25.0, 0.0, 0.0]
    seen = plates.positions.copy()
    seen[hidden, 1] = np.nan
    gapped = restored(seen, markers=names)
    options = fillings.fill_options(max_altered_share=1.0)
    mesh = api.infer_mesh([gapped])
    done = treated(fill_gaps(gapped, mesh, options=options))
    [left] = done.gaps_left
    assert (left.start, left.reason.text) == (0, "at the recording's start")
    filled = hidden[hidden >= left.stop]
    distance = np.linalg.norm((done.positions - plates.positions)[filled, 1], axis=1)
    assert distance.mean() < 0.8 and distance.max() < 4
    assert (distance <= done.error95[filled, 1]).mean() > 0.85


def test_a_marker_that_is_hardly_there(chain):
    left_open(fill(chain, [(9, 100, 1430)]), "marker seen in 11% of the frames (fill.min_seen_share: 0.3)")
    filled_well(fill(chain, [(9, 100, 1430)], min_seen_share=0.0, max_gap_s=None), gaps=1, error=3)
    done = fill(chain, [(9, 20, 1480)], min_seen_share=0.0, max_gap_s=None)
    left_open(done, "no method could fill it; fewest neighbours seen: 0")


def test_many_markers():
    wide = bodies.recording(*bodies.subject(4, tree=(None, *range(24)), frames=400)[:2])
    filled_well(fill(wide, [(3, 100, 150), (50, 120, 160), (99, 300, 350)]), gaps=3, error=0.1)


def test_many_frames():
    """Skin that moves by itself, smoothly: what is learned from frames far apart must predict how it goes on from one to the next."""
    names, positions, _ = bodies.subject(4, frames=40_000)
    noise = np.random.default_rng(2).normal(0, 1, positions.shape).reshape(len(positions), -1)
    skin = np.stack([np.convolve(trajectory, np.hanning(41), mode="same") for trajectory in noise.T], axis=1)
    whole = bodies.recording(names, positions + skin.reshape(positions.shape))
    done = fill(whole, [(3, 10_000, 10_010), (15, 30_000, 30_010)], members=["local_ridge"])
    filled_well(done, gaps=2, error=0.25 * np.linalg.norm(skin.reshape(positions.shape), axis=2).mean())
