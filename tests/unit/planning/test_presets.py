"""The presets: each fits the closed schema, alone and over the shipped config, and selects what its first lines say."""

import copy
from dataclasses import replace

import jsonschema
import pytest
import yaml

from markermend.options.config import read_config
from markermend.planning import option_schema
from support.paths import PROJECT

PRESETS = {path.stem: path for path in sorted((PROJECT / "config/presets").glob("*.yaml"))}
MODELS = ("linear_regression", "local_interpolation", "local_quadratic", "local_grnn")


def merged(config, preset):
    """What Snakemake makes of a config file over another: mappings are merged, all else is replaced."""
    out = copy.deepcopy(config)
    for key, value in preset.items():
        out[key] = merged(out.get(key) or {}, value) if isinstance(value, dict) else value
    return out


def preset(name):
    return yaml.safe_load(PRESETS[name].read_text(encoding="utf-8"))


def options(name):
    return read_config(preset(name))


@pytest.mark.parametrize("name", PRESETS)
def test_it_fits_the_closed_schema_and_means_the_same_over_the_shipped_config(name, config):
    whole = merged(config, preset(name))
    for each in (preset(name), whole):
        jsonschema.validate(each, option_schema.schema())
    assert read_config(whole) == options(name)
    assert options(name) != read_config({})


@pytest.mark.parametrize("name", ["published_pma_text", "published"])
def test_the_text_of_tits2018(name):
    fill, predictors = options(name)["fill"], options(name)["predictors"]
    ensemble, distances = fill.ensemble, fill.ensemble.distances
    assert fill.members == MODELS and not fill.reuse_filled and not fill.smoothing_s
    assert (ensemble.weights, ensemble.time_constraint, ensemble.fallback_members) == ("pma", "laboratory", ())
    assert (distances.references, distances.reference_choice, distances.smoothing_s) == (3, "seen", 0)
    assert (distances.spacing_references, distances.spacing_rounds) == (1, 1)
    assert (distances.spacing_lower_quantile, distances.spacing_upper_quantile) == (0.05, 0.95)
    assert predictors.linear_regression.centring == "available"
    assert (predictors.reference_triangle.ridge, predictors.reference_triangle.kernel_width_sigmas) == (0, 0.3)
    assert (
        fill.max_gap_s is None
        and fill.max_error_mm is None
        and fill.max_error95_mm is None
        and fill.max_altered_share == 1
    )


def test_the_program_of_tits2018():
    fill, predictors = options("published_pma_code")["fill"], options("published_pma_code")["predictors"]
    ensemble, distances = fill.ensemble, fill.ensemble.distances
    assert set(fill.members) == {*MODELS, "weighted_pca"} and fill.reuse_filled and fill.smoothing_s == 0.07
    assert (ensemble.weights, ensemble.time_constraint, ensemble.member_smoothing_s) == ("pma", "local", 0.07)
    assert (distances.spacing_references, distances.spacing_rounds, distances.spacing_order) == (3, 5, "steadiest_last")
    assert (distances.spacing_lower_quantile, distances.spacing_upper_quantile) == (0.01, 0.99)
    assert predictors.linear_regression.centring == "complete"
    assert predictors.weighted_pca.borders == "nearest" and predictors.weighted_pca.strategy == "single"
    # Half the weight at a distance of 0.3: exp(-x^2 / (2 width^2)) = 1/2.
    assert predictors.reference_triangle.kernel_width_sigmas == pytest.approx(0.3 / (2 * 0.6931472) ** 0.5, abs=1e-4)


def test_the_pipeline_of_the_papers():
    own = options("published")
    assert own["general"].detect == ("peaks", "noise", "steps", "slow")
    assert all(own[stage].preset == "paper" for stage in own["general"].detect)
    methods = {stage: own["repair"].methods[stage] for stage in own["general"].detect}
    assert methods == {
        "peaks": ("spline",),
        "noise": ("savitzky_golay",),
        "steps": ("replicated_network",),
        "slow": ("replicated_network",),
    }
    assert not own["repair"].objections
    assert own["fill"] == options("published_pma_text")["fill"]


def test_gait_fills_short_gaps_within_a_centimetre_and_writes_trc():
    own = options("gait")
    assert (own["fill"].max_gap_s, own["fill"].max_error_mm, own["fill"].max_error95_mm) == (0.2, 10, 20)
    assert own["repair"].max_error_mm == 10 and own["export"].also_trc and not own["fill"].fill_ends


def test_animation_fills_longer_gaps_and_ends_on_request_alone():
    fill, usual = options("animation")["fill"], read_config({})["fill"]
    assert fill.max_gap_s > usual.max_gap_s and fill.max_error_mm > usual.max_error_mm
    assert fill.max_error95_mm > usual.max_error95_mm and fill.min_seen_share < usual.min_seen_share
    assert not fill.fill_ends
    with_ends = merged(preset("animation"), {"fill": {"fill_ends": True}})
    assert read_config(with_ends)["fill"] == replace(fill, fill_ends=True)


def test_careful_protects_every_marker_and_looks_for_everything():
    own = options("careful")
    assert own["general"].protect == ("*",) == own["fill"].protect == own["repair"].protect
    assert own["general"].detect == read_config({})["general"].detect
