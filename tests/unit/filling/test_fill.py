"""What is filled and what stays open, with reasons; measured samples never change."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.changes import Change, Outcome
from markermend.core.decisions import EVER, Decision
from markermend.core.poses import Poses
from markermend.core.reasons import Cause
from markermend.core.recording import FILLED, MEASURED, MISSING, ORIGINS
from markermend.filling.fill import fill_gaps
from markermend.mesh.inference import infer_mesh
from markermend.options.mesh import MeshOptions
from support import bodies
from support.fillings import fill as fill_with_defaults
from support.fillings import fill_options, neighbours, restored, rigid_body
from support.naive.numerics import symmetric_smoothing
from support.treated import treated, weights

QUICK = ["local_ridge", "local_interpolation", "spline"]
MARKER, OTHER = 7, 12
GAP = (MARKER, 200, 240)


def changes_of(recording, near, members=QUICK, **changed):
    return fill_with_defaults(recording, near, members=members, **changed)


def fill(recording, near, **changed):
    return treated(changes_of(recording, near, **changed))


@pytest.fixture(scope="module")
def person(walker):
    """Six seconds of the walker: positions, names, neighbours."""
    positions = walker.recording.positions[:600]
    return positions, walker.recording.markers, neighbours(positions)


@pytest.fixture(scope="module")
def torso(person):
    """The first twelve markers alone."""
    positions = person[0][:, :12]
    return positions, person[1][:12], neighbours(positions)


def gapped(person, *gaps, **facts):
    positions, markers, _ = person
    damaged = positions.copy()
    for marker, start, stop in gaps:
        damaged[start:stop, marker] = np.nan
    return restored(damaged, markers=markers, **facts)


def reasons(result):
    return {entry.marker: entry.reason.text for entry in result.gaps_left}


def test_gaps_are_filled_and_nothing_else_changes(person):
    recording = gapped(person, (7, 200, 240), (12, 220, 300), (7, 400, 405))
    before = recording.positions.copy()
    result = fill(recording, person[2])
    assert np.array_equal(recording.positions, before, equal_nan=True)
    missing = recording.missing
    assert np.array_equal(result.positions[~missing], before[~missing])
    assert (result.origin[missing] == FILLED).all() and (result.origin[~missing] == MEASURED).all()
    assert (result.error[missing] > 0).all() and (result.error95[missing] > result.error[missing]).all()
    assert (result.error[~missing] == 0).all()
    assert np.linalg.norm((result.positions - person[0])[missing], axis=1).mean() < 10
    filled = [(entry.marker, entry.start, entry.stop) for entry in result.fills]
    assert sorted(filled) == sorted((person[1][m], a, b) for m, a, b in ((7, 200, 240), (7, 400, 405), (12, 220, 300)))
    for entry in result.fills:
        assert sum(weights(entry).values()) == pytest.approx(1, abs=0.01)
    assert result.gaps_left == []


def test_a_complete_recording_comes_back_as_it_was(person):
    result = fill(gapped(person), person[2])
    assert np.array_equal(result.positions, person[0])
    assert result.fills == [] and result.gaps_left == []


@pytest.mark.parametrize(
    ("gap", "changed", "cause", "setting"),
    [
        ((7, 100, 350), {}, Cause.TOO_LONG, "fill.max_gap_s"),
        ((7, 200, 220), {"max_error_mm": 0.01}, Cause.UNCERTAIN, "fill.max_error_mm"),
        ((7, 200, 220), {"max_error95_mm": 0.01}, Cause.UNCERTAIN, "fill.max_error95_mm"),
        ((7, 200, 220), {"max_altered_share": 0.0001}, Cause.TOO_MUCH, "fill.max_altered_share"),
    ],
)
def test_what_stays_open_has_the_limit_that_caused_it(person, gap, changed, cause, setting):
    recording = gapped(person, gap)
    result = changes_of(recording, person[2], **changed)
    (change,) = result.changes
    assert (change.outcome, change.classes, change.samples) == (Outcome.LEFT, ("gap",), gap[2] - gap[1])
    assert (change.reason.cause, change.reason.limit.setting) == (cause, setting)
    assert change.reason.limit.actual > change.reason.limit.value
    assert change.reason.limit.text in change.reason.text
    filled = result.recording
    assert np.array_equal(filled.positions, recording.positions, equal_nan=True)
    assert (filled.origin[gap[1] : gap[2], 7] == MISSING).all()
    assert np.isnan(filled.error[gap[1] : gap[2], 7]).all()


def test_a_change_states_how_a_gap_was_filled(person):
    result = changes_of(gapped(person, (12, 220, 300), (7, 200, 240)), person[2])
    assert [change.marker for change in result.changes] == sorted(person[1][m] for m in (7, 12))
    for change in result.changes:
        place = slice(change.start, change.stop), person[1].index(change.marker)
        assert (change.outcome, change.samples, change.reason) == (Outcome.FILLED, change.stop - change.start, None)
        assert change.expected_error_mm == round(float(result.recording.error[place].max()), 3)
        assert change.expected_error95_mm == round(float(result.recording.error95[place].max()), 3)
        shares = [own.weight for own in change.member_weights]
        assert shares == sorted(shares, reverse=True) and sum(shares) == pytest.approx(1, abs=0.002)
        assert change.method == ("ensemble" if len(shares) > 1 else change.member_weights[0].member)


def test_ends_are_filled_on_request(person):
    recording = gapped(person, (7, 0, 30), (12, 570, 600))
    result = fill(recording, person[2], fill_ends=True)
    assert len(result.fills) == 2
    assert np.linalg.norm((result.positions - person[0])[recording.missing], axis=1).mean() < 25


def test_a_blackout_stays_open_unless_short_enough_to_interpolate(torso):
    everything = range(torso[0].shape[1])
    long = gapped(torso, *((m, 200, 290) for m in everything))
    result = fill(long, torso[2])
    assert len(result.gaps_left) == len(everything)
    assert set(reasons(result).values()) == {"no method could fill it; fewest neighbours seen: 0"}
    short = gapped(torso, *((m, 200, 204) for m in everything))
    result = fill(short, torso[2])
    assert not result.gaps_left
    assert {entry.method for entry in result.fills} == {"spline"}
    assert np.linalg.norm((result.positions - torso[0])[200:204], axis=2).max() < 10


def test_twenty_concurrent_gaps_are_all_filled(person):
    rng = np.random.default_rng(3)
    recording = gapped(person, *((m, 250, 290) for m in rng.permutation(person[0].shape[1])[:20]))
    result = fill(recording, person[2])
    assert len(result.fills) == 20
    assert np.linalg.norm((result.positions - person[0])[recording.missing], axis=1).mean() < 40


def test_no_marker_need_be_complete_and_reuse_is_optional(torso):
    everything = range(torso[0].shape[1])
    recording = gapped(torso, *((m, 20 + 10 * m, 32 + 10 * m) for m in everything))
    for reuse in (True, False):
        result = fill(recording, torso[2], averaging={"pseudo_gaps": 2}, reuse_filled=reuse)
        assert len(result.fills) == len(everything)
        assert np.linalg.norm((result.positions - torso[0])[recording.missing], axis=1).mean() < 8


def test_eight_markers_are_enough():
    positions = rigid_body(frames=400, markers=8)
    damaged = positions.copy()
    damaged[100:160, 2] = np.nan
    damaged[130:200, 5] = np.nan
    result = fill(restored(damaged), neighbours(positions))
    assert np.abs(result.positions - positions).max() < 0.5


def test_repaired_samples_keep_their_origin(person):
    recording = gapped(person, (7, 200, 220))
    origin = recording.origin.copy()
    origin[100:110, 7] = ORIGINS.index("peak")
    result = fill(replace(recording, origin=origin), person[2])
    assert (result.origin[100:110, 7] == ORIGINS.index("peak")).all()


def test_the_result_is_the_same_every_time(person):
    recording = gapped(person, (7, 200, 240), (12, 220, 300))
    first, second = fill(recording, person[2]), fill(recording, person[2])
    assert np.array_equal(first.positions, second.positions)
    assert first.facts == second.facts


def test_the_entry_function_takes_neighbours_from_the_mesh_and_members_from_the_options(person):
    recording = gapped(person, (7, 200, 240))
    mesh = infer_mesh([bodies.recording(person[1], person[0])], options=MeshOptions())
    options = fill_options(members=["spline"])
    result = fill_gaps(recording, mesh, options=options)
    assert [change.method for change in result.changes] == ["spline"]
    near = mesh.neighbour_indices(recording.markers)
    assert np.array_equal(result.recording.positions, fill(recording, near, members=["spline"]).positions)


def fill_decided(person, recording, decisions=(), **changed):
    return fill(recording, person[2], members=["local_ridge", "spline"], decisions=decisions, **changed)


def decide(person, verb, value="", marker=MARKER, start=205, stop=206):
    return Decision(person[1][marker], start, stop, verb, value, "why")


class TestDecisions:
    """A person's decisions: no limit holds against them, and no other gap changes by them."""

    @pytest.mark.parametrize(
        "limits",
        [
            {"max_gap_s": 0.1},
            {"max_error_mm": 0.001},
            {"max_error95_mm": 0.001},
            {"max_altered_share": 0.00001},
            {"min_seen_share": 0.99},
            {"border_s": 2.5},
        ],
        ids=str,
    )
    def test_a_gap_that_a_person_accepts_is_filled_whatever_the_limits(self, person, limits):
        recording = gapped(person, GAP)
        assert fill_decided(person, recording, **limits).gaps_left
        result = fill_decided(person, recording, [decide(person, "accept", "gap")], **limits)
        assert result.gaps_left == []
        assert result.fills[0].decisions == ("accept gap",)
        assert np.linalg.norm((result.positions - person[0])[recording.missing], axis=1).max() < 30
        assert (result.error[recording.missing] > 0).all()

    @pytest.mark.parametrize("verb", ["reject gap", "method leave", "protect"])
    def test_a_gap_that_a_person_leaves_stays_open(self, person, verb):
        recording = gapped(person, GAP)
        result = fill_decided(person, recording, [decide(person, *verb.split())])
        assert np.array_equal(result.positions, recording.positions, equal_nan=True)
        (left,) = result.gaps_left
        assert (left.reason.text, left.decisions) == (f"a person decided: {verb}", (f"{verb}",))

    def test_a_gap_is_filled_by_the_persons_method_alone_even_where_it_is_no_member(self, person):
        recording = gapped(person, (MARKER, 200, 280))
        for method in ("spline", "linear_regression"):
            result = fill_decided(person, recording, [decide(person, "method", method)])
            (entry,) = result.fills
            assert (entry.method, weights(entry), entry.decisions) == (
                method,
                {method: 1.0},
                (f"method {method}",),
            )

    def test_a_method_of_repair_says_nothing_about_gaps(self, person):
        recording = gapped(person, GAP)
        plain, result = (
            fill_decided(person, recording),
            fill_decided(person, recording, [decide(person, "method", "savitzky_golay")]),
        )
        assert np.array_equal(plain.positions, result.positions) and plain.changes == result.changes

    @pytest.mark.parametrize("verb", ["accept gap", "method spline"])
    def test_no_other_gap_changes_by_a_decision_to_fill(self, person, verb):
        recording = gapped(person, GAP, (OTHER, 210, 260), (MARKER, 400, 430))
        options = {"max_gap_s_of": {person[1][MARKER]: 0.35}}
        plain = fill_decided(person, recording, **options)
        result = fill_decided(person, recording, [decide(person, *verb.split())], **options)
        assert len(plain.fills) == 2 and len(result.fills) == 3
        others = np.ones(recording.missing.shape, bool)
        others[GAP[1] : GAP[2], MARKER] = False
        for one, other in ((plain.positions, result.positions), (plain.error, result.error)):
            assert np.array_equal(one[others], other[others], equal_nan=True)

    @pytest.mark.parametrize(
        ("gap", "facts", "options"),
        [((MARKER, 0, 600), {}, {}), (GAP, {"kind": "static"}, {}), (GAP, {}, {"protect": ["*"]})],
        ids=["never seen", "static", "protected by an option"],
    )
    def test_what_no_person_can_change(self, person, gap, facts, options):
        recording = gapped(person, gap, **facts)
        result = fill_decided(person, recording, [decide(person, "accept", "gap")], **options)
        assert (result.origin[gap[1] : gap[2], MARKER] == MISSING).all() and not result.fills

    def test_decisions_on_other_markers_and_frames_change_nothing(self, person):
        recording = gapped(person, GAP, (OTHER, 210, 260))
        decided = [
            Decision("unknown", -EVER, EVER, "accept", "gap"),
            decide(person, "reject", "gap", start=0, stop=200),
            decide(person, "method", "leave", start=240, stop=600),
            decide(person, "reject"),
        ]
        plain, result = fill_decided(person, recording), fill_decided(person, recording, decided)
        assert np.array_equal(plain.positions, result.positions) and plain.changes == result.changes

    def test_a_confirmed_gap_is_filled_where_an_input_turns_out_too_uncertain(self, person):
        recording = gapped(person, GAP, (MARKER, 400, 430))
        accept = [decide(person, "accept", "gap")]
        usual = fill_decided(person, recording, accept)
        # Within the limit by the prior radius, so that it is an input; beyond it by the calibrated one.
        limit = 0.99 * usual.error[400:430, MARKER].max()
        result = fill_decided(person, recording, accept, max_error_mm=limit)
        assert (result.origin[GAP[1] : GAP[2], MARKER] == FILLED).all()
        assert (result.origin[400:430, MARKER] == MISSING).all()


def test_jumps_that_were_left_do_not_make_other_gaps_uncertain(person):
    """All markers jump at one frame, which is reported and left; a gap elsewhere is no less certain for it."""
    recording = gapped(person, *((m, 150, 152) for m in range(len(person[1]))))
    usual = changes_of(recording, person[2])
    recording.positions[300:] += [0.0, 40.0, 0.0]
    left = [
        Change(marker, 300, len(recording.positions), ("shift",), Outcome.LEFT, 1.0, "y", None)
        for marker in recording.markers
    ]
    result = changes_of(recording, person[2], repairs=left).recording
    missing = recording.missing
    assert np.nanmax(result.error[missing]) < 2 * np.nanmax(usual.recording.error[missing])
    assert not np.isnan(result.positions).any()


def test_the_time_constraint_matters_where_a_model_is_off_by_a_constant(person):
    """A marker that sits 20 mm beside its place from 1 s before the gap to 1 s after it."""
    positions, names, near = person
    marker, start, stop = GAP
    moved = positions.copy()
    moved[start - 100 : stop + 100, marker] += [20.0, 0, 0]
    truth = moved[start:stop, marker].copy()
    moved[start:stop, marker] = np.nan
    errors = {}
    for constraint in ("laboratory", "local", "off"):
        averaging = {"time_constraint": constraint, "weights": "pma", "fallback_members": ()}
        averaging["distances"] = replace(fill_options().ensemble.distances, reference_choice="seen")
        found = fill(restored(moved, markers=names), near, members=["local_grnn"], averaging=averaging)
        errors[constraint] = np.linalg.norm(found.positions[start:stop, marker] - truth, axis=1).mean()
    assert errors["off"] > 2 * max(errors["laboratory"], errors["local"])
    assert abs(errors["laboratory"] - errors["local"]) > 0.01


def test_what_was_filled_may_be_smoothed_with_the_samples_beside_it(person):
    positions, names, near = person
    gapped = positions.copy()
    gapped[200:240, MARKER] = np.nan
    whole, smooth = (fill(restored(gapped, markers=names), near, smoothing_s=window).positions for window in (0, 0.07))
    assert np.allclose(smooth[200:240, MARKER], symmetric_smoothing(whole[:, MARKER], 7)[200:240])
    assert np.array_equal(smooth[~np.isnan(gapped)], gapped[~np.isnan(gapped)])


def poses_of(person, *names):
    """Ten poses of each recording."""
    positions, markers, _ = person
    numbers = np.repeat(np.arange(len(names)), 10)
    rows = np.tile(np.arange(0, 500, 50), len(names))
    return Poses(tuple(markers), positions[rows], names, numbers, rows)


@pytest.mark.parametrize(
    ("kind", "pool", "members", "learned_from"),
    [
        ("dynamic", True, QUICK, ["jump"]),
        ("dynamic", True, ["local_ridge_wide"], ["jump"]),
        ("dynamic", True, ["spline"], None),
        ("dynamic", False, QUICK, None),
        ("static", True, QUICK, None),
    ],
)
def test_what_filling_learns_from_is_stated(torso, kind, pool, members, learned_from):
    recording = gapped(torso, (3, 100, 120), recording="walk", kind=kind)
    mesh = infer_mesh(
        [bodies.recording(torso[1], torso[0], name=name) for name in ("walk", "jump")], options=MeshOptions()
    )
    options = fill_options(members=members, pool=pool)
    filled = fill_gaps(recording, mesh, options=options, poses=poses_of(torso, "another mesh", "jump", "walk"))
    assert filled.recording.facts.get("learned_from") == learned_from
    assert "learned_from" not in recording.facts


def test_own_poses_and_those_of_another_mesh_alter_nothing(torso):
    recording = gapped(torso, (3, 100, 120), recording="walk", kind="dynamic")
    mesh = infer_mesh([bodies.recording(torso[1], torso[0], name="walk")], options=MeshOptions())
    options = fill_options(members=QUICK)
    alone = fill_gaps(recording, mesh, options=options)
    other = fill_gaps(recording, mesh, options=options, poses=poses_of(torso, "another mesh", "walk"))
    assert np.array_equal(alone.recording.positions, other.recording.positions, equal_nan=True)
    assert other.changes == alone.changes and other.recording.facts == alone.recording.facts
