"""What holds for every predictor: the interface, exactness on rigid bodies, and that hidden samples stay hidden."""

import numpy as np
import pytest

from markermend.prediction.interpolation import KINDS
from markermend.prediction.local_ridge.gaussian_process import LocalGaussian
from markermend.prediction.neural_network.predictor import KINDS as NETWORK_KINDS
from markermend.prediction.registry import NETWORKS, REGISTRY, learn_from_pool, members
from support.fillings import predictor, predictor_options, rigid_body, scene

NAMES = sorted(REGISTRY)
EXACT = [name for name in NAMES if name.startswith("local") or name == "linear_regression"]
ON_THE_BODY = [*EXACT, "msvd", "weighted_pca", "replicated_network"]
IN_TIME = list(KINDS)


@pytest.fixture(scope="module")
def person(walker):
    """Six seconds of the walker."""
    return walker.recording.positions[:600]


@pytest.mark.parametrize("name", NAMES)
def test_neither_input_nor_prediction_depends_on_the_hidden_samples(name, person):
    positions = person.copy()
    before = positions.copy()
    first = predictor(name).predict(scene(positions), 7, 400, 440)
    assert np.array_equal(positions, before)
    assert first.positions.shape == (42, 3) and first.error.shape == (42,)
    nearby = scene(positions).neighbours
    changed = positions.copy()
    changed[400:440, 7] += 500.0
    again = predictor(name).predict(type(scene(positions))(changed, 100.0, nearby), 7, 400, 440)
    assert np.array_equal(first.positions, again.positions, equal_nan=True)
    assert np.array_equal(first.error, again.error, equal_nan=True)


@pytest.mark.parametrize("name", EXACT)
def test_a_marker_of_a_rigid_body_is_recovered_exactly(name):
    positions = rigid_body()
    seen = scene(positions)
    found = predictor(name).predict(seen, 2, 100, 180).positions
    # The ridge keeps its penalty, and a regression on laboratory coordinates is exact for rigid motion.
    assert np.abs(found - positions[99:181, 2]).max() < 0.01


@pytest.mark.parametrize("name", NAMES)
def test_gaps_at_the_ends_leave_the_border_outside_open(name, person):
    positions = person
    frames = len(positions)
    first = predictor(name).predict(scene(positions), 3, 0, 20).positions
    last = predictor(name).predict(scene(positions), 3, frames - 20, frames).positions
    assert first.shape == last.shape == (22, 3)
    assert np.isnan(first[0]).all() and np.isnan(last[-1]).all()
    if name not in IN_TIME:
        assert np.isfinite(first[1:]).all() and np.isfinite(last[:-1]).all()
    else:
        assert np.isnan(first[:-1]).all() and np.isnan(last[1:]).all()


@pytest.mark.parametrize("name", ON_THE_BODY)
def test_references_may_come_and_go_during_the_gap(name, person):
    truth = person
    seen = scene(truth)
    near = seen.neighbours[7]
    gapped = truth.copy()
    gapped[400:470, 7] = np.nan
    gapped[400:440, near[0]] = np.nan
    gapped[430:470, near[1]] = np.nan
    gapped[405:410, near[2]] = np.nan
    found = predictor(name).predict(type(seen)(gapped, 100.0, seen.neighbours), 7, 400, 470).positions
    assert np.isfinite(found).all()
    assert np.linalg.norm(found - truth[399:471, 7], axis=1).mean() < 40


@pytest.mark.parametrize("name", ON_THE_BODY)
def test_no_marker_need_be_complete(name, person):
    truth = person
    gapped = truth.copy()
    for marker in range(truth.shape[1]):
        gapped[10 * marker + 30 : 10 * marker + 45, marker] = np.nan
    assert not np.isfinite(gapped).all(axis=(0, 2)).any()
    found = predictor(name).predict(scene(gapped), 5, 80, 95).positions
    assert np.linalg.norm(found - truth[79:96, 5], axis=1).mean() < 30


@pytest.mark.parametrize("name", NAMES)
def test_a_marker_that_is_hardly_or_never_seen_is_not_invented(name, person):
    positions = person.copy()
    positions[:, 4] = np.nan
    seen = scene(person)
    never = predictor(name).predict(type(seen)(positions, 100.0, seen.neighbours), 4, 100, 120)
    assert np.isnan(never.positions).all()
    positions[:10, 4] = person[:10, 4]
    hardly = predictor(name).predict(type(seen)(positions, 100.0, seen.neighbours), 4, 100, 120)
    assert np.isnan(hardly.positions).all()


@pytest.mark.parametrize("name", ON_THE_BODY)
def test_a_blackout_leaves_nothing_to_go_by(name, person):
    positions = person.copy()
    positions[300:320] = np.nan
    found = predictor(name).predict(scene(positions), 5, 300, 320).positions
    assert np.isnan(found[1:-1]).all()


def test_members_are_made_by_name_and_wrong_names_are_refused():
    made = members(["spline", "local_ridge_wide"], predictor_options())
    assert [member.name for member in made] == ["spline", "local_ridge_wide"]
    assert made[1].options.anchors == 6
    with pytest.raises(ValueError, match="unknown member nonsense"):
        members(["nonsense"], predictor_options())
    with pytest.raises(ValueError, match="named twice"):
        members(["spline", "spline"], predictor_options())


def test_sharing_what_is_learned_changes_nothing(walker):
    positions = walker.recording.positions[:600].copy()
    gaps = [(200, 240), (300, 320), (420, 460)]
    for start, stop in gaps:
        positions[start:stop, 7] = np.nan
    positions[305:500, [8, 9]] = np.nan
    shared = scene(positions)
    for name in ("local_ridge", "local_ridge_wide", "linear_regression", "local_grnn", "local_interpolation"):
        member = predictor(name)
        for start, stop in gaps:
            found, alone = (
                member.predict(shared, 7, start, stop),
                predictor(name).predict(scene(positions), 7, start, stop),
            )
            assert np.array_equal(found.positions, alone.positions, equal_nan=True)
            assert np.array_equal(found.error, alone.error, equal_nan=True)
            assert np.isfinite(found.positions).all()


def test_each_variant_of_the_ridge_has_a_gaussian_process():
    made = members(["local_gp_wide", "local_gp"], predictor_options())
    assert [member.name for member in made] == ["local_gp_wide", "local_gp"]
    assert [type(member) for member in made] == [LocalGaussian, LocalGaussian]
    assert [member.options.anchors for member in made] == [6, 3]


def test_the_local_ridge_the_local_process_and_their_variants_learn_from_the_pool():
    assert all(
        learn_from_pool(["spline", name]) for name in ("local_ridge", "local_ridge_fine", "local_gp", "local_gp_wide")
    )
    assert not learn_from_pool(["spline", "local_grnn", "linear_regression"])


def test_the_networks_are_those_of_their_package():
    assert set(NETWORKS) == set(NETWORK_KINDS)
