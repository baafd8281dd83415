"""The experiment on repair: errors of methods after the same distortion, and what they follow from."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.evaluation.artifacts2022 import readings, repairs
from markermend.evaluation.artifacts2022.options import RepairExperimentOptions
from markermend.evaluation.artifacts2022.published_detectors import PublishedDetectors, network_of
from markermend.evaluation.artifacts2022.repairs import Distortion

PUBLISHED = readings.published_options({}, network_steps=5)

DETECTORS = PublishedDetectors(PUBLISHED, network_of(PUBLISHED))


@pytest.fixture(scope="module")
def clean(walker):
    recording = walker.recording
    return replace(recording, positions=recording.positions[:, :12], markers=recording.markers[:12])


def errors_of(clean, distortion, methods, seed=1):
    options = RepairExperimentOptions(methods=tuple(methods))
    return repairs.repair_run(clean, distortion, options=options, published=DETECTORS, rng=np.random.default_rng(seed))


def test_the_distorted_recordings_have_the_error_of_the_formula(clean):
    runs = [
        errors_of(clean, Distortion("peaks", 10.0, 20.0), ["distorted"], seed)["distorted", "perfect"]
        for seed in range(20)
    ]
    coordinates = 3 * len(clean.markers)
    assert np.mean(runs) == pytest.approx(np.sqrt(0.2 / coordinates * (10**2 + 4**2)), rel=0.05)


def test_known_peaks_are_removed_by_interpolation(clean):
    errors = errors_of(clean, Distortion("peaks", 10.0, 10.0), ["distorted", "linear", "spline", "savitzky_golay"])
    assert max(errors["spline", "perfect"], errors["linear", "perfect"]) < 0.2 * errors["distorted", "perfect"]
    assert errors["linear", "perfect"] < errors["linear", "classified"]
    assert ("distorted", "classified") not in errors


def test_equal_seeds_give_equal_errors(clean):
    distortion = Distortion("steps", 10.0, 10.0)
    first, again, other = (errors_of(clean, distortion, ["distorted", "linear"], seed) for seed in (3, 3, 4))
    assert first == again and first != other


def test_our_repair_follows_our_detectors(clean):
    errors = errors_of(clean, Distortion("peaks", 10.0, 5.0), ["distorted", "default"])
    assert errors["default", "perfect"] < 0.3 * errors["distorted", "perfect"]
    assert errors["default", "classified"] < errors["distorted", "perfect"]


def test_only_findings_of_the_class_are_repaired(clean, monkeypatch):
    looked_for = []
    detect = repairs.api.detect
    monkeypatch.setattr(
        repairs.api, "detect", lambda *given: looked_for.append(given[2].general.detect) or detect(*given)
    )
    errors_of(clean, Distortion("noise", 10.0, 10.0), ["linear"])
    assert looked_for == [("peaks", "noise")]


def test_rows_have_one_line_for_each_method_and_location():
    errors = {("distorted", "perfect"): 0.2, ("linear", "classified"): 0.1}
    table = repairs.repair_rows("walk", Distortion("noise", 10.0, 5.0), [(0, errors), (1, errors)], coordinates=36)
    assert list(table.columns) == list(repairs.COLUMNS) and len(table) == 4
    assert table["rmse_mm"].tolist() == [0.2, 0.1, 0.2, 0.1] and set(table["run"]) == {0, 1}
