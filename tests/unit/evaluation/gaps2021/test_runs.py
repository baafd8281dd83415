"""The runs of the experiment: the same gaps for all methods, and errors of what was filled."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.events import mask
from markermend.evaluation.gaps2021 import runs as experiment
from markermend.evaluation.gaps2021.drawn import make_runs
from markermend.evaluation.gaps2021.fillings import count_parameters, fill_runs
from markermend.evaluation.gaps2021.methods import GROUPS, METHODS, NETWORKS
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.recordings import synthetic
from markermend.evaluation.synthetic_options import SyntheticOptions

OPTIONS = Gaps2021Options(max_duration_s=4, mean_lengths=(10, 40))
OPTIONS = replace(OPTIONS, networks=replace(OPTIONS.networks, epochs=3, recurrent_units=5))


@pytest.fixture(scope="module")
def subject():
    made = SyntheticOptions(duration_s=6)
    return {name: experiment.prepare(synthetic(name, made, seed=1), OPTIONS) for name in ("walk", "exercise")}


@pytest.fixture(scope="module")
def mesh(subject):
    return experiment.subject_mesh("walk", subject)


@pytest.fixture(scope="module")
def drawn(subject):
    return make_runs("walk", subject["walk"], OPTIONS, numbers=range(2), seed=1)


def test_recordings_are_shortened_and_denoised(subject):
    assert subject["walk"].frames == 400
    jerk = np.linalg.norm(np.diff(subject["walk"].positions, 3, axis=0), axis=2).mean()
    assert jerk < 0.1  # 0.2 mm of noise has 1.4 mm


def test_the_mesh_of_a_subject_comes_from_all_of_its_recordings(subject, mesh):
    assert set(mesh.recordings) == {"walk", "exercise"}
    assert len(mesh.segments) > len(experiment.subject_mesh("walk", {"walk": subject["walk"]}).segments) > 1


def test_runs_differ_and_begin_alike_whatever_their_number(subject, drawn):
    assert [(run.length, run.number) for run in drawn] == [(10, 0), (10, 1), (40, 0), (40, 1)]
    assert len({tuple(run.gaps) for run in drawn}) == 4
    (last,) = make_runs("walk", subject["walk"], replace(OPTIONS, mean_lengths=(40,)), numbers=[1], seed=1)
    assert last.gaps == drawn[-1].gaps
    for run in drawn:
        hidden = mask(run.gaps, subject["walk"].frames, subject["walk"].markers)
        assert len(run.gaps) == 2 and np.array_equal(run.hidden.missing, hidden)
        assert np.array_equal(run.hidden.positions[~hidden], subject["walk"].positions[~hidden])


def test_gaps_that_are_too_long_for_the_recording_are_left_out(subject, mesh):
    options = replace(OPTIONS, mean_lengths=(10, 500))
    runs = make_runs("walk", subject["walk"], options, numbers=range(2), seed=1)
    assert [run.length for run in runs] == [10, 10]
    none = make_runs("walk", subject["walk"], replace(OPTIONS, mean_lengths=(500,)), numbers=range(2), seed=1)
    assert not none and experiment.run_rows(subject["walk"], none, mesh, ["linear", "network_linear"], OPTIONS).empty


@pytest.mark.parametrize("methods", GROUPS.values(), ids=GROUPS)
def test_every_method_fills_every_gap(subject, mesh, drawn, methods):
    table = experiment.run_rows(subject["walk"], drawn, mesh, methods, OPTIONS)
    assert tuple(table.columns) == experiment.RUN_COLUMNS[1:] and len(table) == len(methods) * 8
    assert (table["error"] > 0).all() and (table["error"] < 2000).all()
    assert (table["training_frames"] == 400 - table["samples"]).all()
    assert table["parameters"].notna().all() == (methods[0] in NETWORKS)


def test_errors_are_those_of_what_was_filled(subject, mesh, drawn):
    (filled,) = fill_runs(drawn[:1], mesh, "linear", OPTIONS)
    gap = drawn[0].gaps[0]
    m = subject["walk"].markers.index(gap.marker)
    before, after = subject["walk"].positions[[gap.start - 1, gap.stop], m]
    share = np.arange(1, gap.stop - gap.start + 1)[:, None] / (gap.stop - gap.start + 1)
    assert np.allclose(filled[gap.start : gap.stop, m], before + share * (after - before))
    table = experiment.run_rows(subject["walk"], drawn[:1], mesh, ["linear"], OPTIONS)
    away = filled[gap.start : gap.stop, m] - subject["walk"].positions[gap.start : gap.stop, m]
    assert table["error"][0] == pytest.approx(np.sqrt((away**2).mean()))


def test_parameters_follow_from_the_segment_mates(subject, mesh, drawn):
    mates = mesh.segment_mate_indices(subject["walk"].markers)
    count = [len(mates[subject["walk"].markers.index(gap.marker)]) for gap in drawn[0].gaps]
    found = count_parameters(drawn[0], mesh, "network_tanh", OPTIONS)
    assert found == [8 * 6 * own + 8 + 3 * 8 + 3 for own in count]


def test_every_method_is_in_one_group():
    assert [method for group in GROUPS.values() for method in group] == list(METHODS)


def test_a_recording_is_described(subject):
    row = experiment.describe("walk", subject["walk"]).iloc[0]
    assert row["recording"] == "walk" and 0.5 < row["velocity"] < 2
