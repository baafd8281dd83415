"""Thresholds of slow changes: every setting sees the same damage, and counts add up."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.artifacts2022 import slow_sweep
from markermend.evaluation.artifacts2022.options import SlowSweepOptions
from markermend.evaluation.artifacts2022.runs import Condition

OPTIONS = SlowSweepOptions(
    trained_on=("clean",),
    training_frames=(200,),
    network_steps=(2, 20),
    deviations_over=("marker",),
    lower_sigmas=(0.5,),
    min_durations_s=(0.3, 0.5),
)
CONDITION = Condition("paper", 30.0, 20.0)


@pytest.fixture(scope="module")
def counts(walker):
    recording = walker.recording
    clean = replace(recording, positions=recording.positions[:, :12], markers=recording.markers[:12])
    networks = slow_sweep.make_networks(clean, OPTIONS)
    return clean, slow_sweep.sweep_run(
        clean, CONDITION, networks=networks, options=OPTIONS, rng=np.random.default_rng(1)
    )


def test_every_setting_is_counted_on_the_same_damage(counts):
    clean, own = counts
    assert list(own) == [
        ("clean", 200, 2, "marker", 0.5, 0.3),
        ("clean", 200, 2, "marker", 0.5, 0.5),
        ("clean", 200, 20, "marker", 0.5, 0.3),
        ("clean", 200, 20, "marker", 0.5, 0.5),
    ]
    assert len({count.found + count.missed for count in own.values()}) == 1
    assert all(count.clean_found <= count.false and count.clean < clean.positions.size for count in own.values())


def test_longer_training_leaves_a_smaller_residual_and_longer_findings_are_fewer(counts):
    _, own = counts
    assert (
        own["clean", 200, 20, "marker", 0.5, 0.3].deviation_mm < own["clean", 200, 2, "marker", 0.5, 0.3].deviation_mm
    )
    for steps in OPTIONS.network_steps:
        short, long = (own["clean", 200, steps, "marker", 0.5, duration] for duration in (0.3, 0.5))
        assert short.found + short.false >= long.found + long.false and short.remaining == long.remaining


def test_runs_are_averaged_by_setting(counts):
    _, own = counts
    table = slow_sweep.sweep_rows("walk", CONDITION, [(0, own), (1, own)])
    assert tuple(table.columns) == slow_sweep.COLUMNS and len(table) == 8
    averaged = slow_sweep.average_sweep(table)
    assert len(averaged) == 4 and averaged["runs"].eq(2).all()
    first = own["clean", 200, 2, "marker", 0.5, 0.3]
    assert averaged["TPR"][0] == pytest.approx(100 * first.found / (first.found + first.missed))
    assert averaged["clean_TPR"][0] == pytest.approx(100 * (1 - first.clean_found / first.clean))


def test_nothing_found_has_no_false_discovery_rate():
    row = {
        "recording": "a",
        "amplitude_mm": 10.0,
        "share_percent": 20.0,
        "trained_on": "clean",
        "training_frames": 200,
        "network_steps": 1,
        "deviation_over": "marker",
    }
    more = {"lower_sigmas": 0.5, "min_duration_s": 0.5, "run": 0, "found": 0, "missed": 5, "false": 0}
    rest = {"clean": 9, "clean_found": 0, "remaining": 0.5, "deviation_mm": 1.0}
    averaged = slow_sweep.average_sweep(pd.DataFrame([{**row, **more, **rest}]))
    assert averaged["TPR"][0] == 0 and np.isnan(averaged["FDR"][0])
