"""Runs of the model averaging paper: the same gaps for every method, errors of each gap, fragments."""

from functools import partial

import numpy as np
import pytest
import yaml

from markermend.core.recording import Recording
from markermend.evaluation.pma2018 import runs
from markermend.evaluation.pma2018.jobs import Condition
from markermend.evaluation.pma2018.methods import published_methods
from markermend.evaluation.pma2018.options import Pma2018Options
from markermend.options.config import read_config
from support.paths import PROJECT

STANDARD = Condition(3, 0.5)


@pytest.fixture(scope="module")
def recording(walker):
    whole = walker.recording
    return Recording(whole.markers[:20], whole.positions[:600, :20], whole.rate)


@pytest.fixture(scope="module")
def text():
    return read_config(yaml.safe_load((PROJECT / "config/presets/published_pma_text.yaml").read_text()))["fill"]


def straight(hidden):
    """Fills each gap with the position before it."""
    yield "held", {gap: hidden.error(gap, hidden.positions[gap.start - 1, gap.marker]) for gap in hidden.gaps}


def test_the_error_is_the_mean_distance_over_the_gap(recording):
    hidden = runs.hide_gaps(recording, STANDARD, rng=np.random.default_rng(1))
    gap = hidden.gaps[0]
    truth = recording.positions[gap.samples]
    off = np.zeros((gap.length, 3))
    off[0] = 3, 0, 4
    assert hidden.error(gap, truth + off) == pytest.approx(5 / gap.length)
    assert np.isnan(hidden.positions[gap.samples]).all()
    assert np.isnan(hidden.positions).any(axis=2).sum() == 3 * 50


def test_gaps_come_from_seed_recording_condition_and_run_alone(recording):
    def places(seed, name, numbers, fill=straight):
        rows = runs.run_rows(recording, runs.Job(name, "text", STANDARD), fill, runs=numbers, seed=seed)
        return rows[rows["method"] == rows["method"].iloc[0]][["run", "marker", "start"]].to_numpy().tolist()

    assert places(1, "walk", range(4)) == places(1, "walk", range(2)) + places(1, "walk", range(2, 4))
    assert places(1, "walk", range(4)) != places(2, "walk", range(4))
    assert places(1, "walk", range(4)) != places(1, "run", range(4))
    assert places(1, "walk", range(1), runs.default_errors) == places(1, "walk", range(1))


def test_a_row_for_each_gap_and_method(recording, text):
    methods = published_methods("text", Pma2018Options())
    fill = partial(runs.published_errors, methods=methods, options=text)
    found = runs.run_rows(recording, runs.Job("walk", "text", STANDARD), fill, runs=range(2), seed=1)
    assert tuple(found.columns) == runs.RUN_COLUMNS and len(found) == 2 * 3 * 8
    assert found["error_mm"].between(0, 500).all()
    singles = found[~found["method"].str.startswith("pma")]
    assert list(dict.fromkeys(singles["method"])) == list(Pma2018Options().models)


def test_our_ensemble_fills_every_gap(recording):
    found = runs.run_rows(recording, runs.Job("walk", "default", STANDARD), runs.default_errors, runs=range(1), seed=3)
    assert set(found["method"]) == {"default"} and found["error_mm"].between(0, 50).all()


def test_fragments_are_named_by_their_place_in_the_whole_recording(recording):
    found = runs.run_rows(recording, runs.Job("walk", "text", Condition(3, 0.5, 2.0)), straight, runs=range(30), seed=1)
    starts = found.groupby("run")["start"].first()
    assert starts.max() > 300 and set(found["duration_s"]) == {2.0}


def test_what_does_not_fit_into_a_recording_gives_no_rows(recording):
    for condition in (Condition(3, 0.5, 7.0), Condition(21, 0.5), Condition(3, 6.5)):
        found = runs.run_rows(recording, runs.Job("walk", "text", condition), straight, runs=range(3), seed=1)
        assert found.empty and tuple(found.columns) == runs.RUN_COLUMNS


@pytest.mark.parametrize(("procedure", "count"), [("text", 8), ("bolero", 1), ("test_text", 2), ("test_program", 2)])
def test_the_constraints_are_off_where_they_are_tested(procedure, count):
    methods = published_methods(procedure, Pma2018Options())
    assert len(methods) == len({method.name for method in methods}) == count
    assert sum(not method.constrained for method in methods) == procedure.startswith("test")
