"""The config in its two tiers: what it is read into, and what is refused with which words."""

import re

import pytest
import yaml

from markermend.options.config import SECTIONS, find_place, own_options, read_config, write_config
from markermend.options.flags import write_flags
from markermend.options.reader import BadOptions
from markermend.options.renamed import RENAMED, renamed
from support.paths import PROJECT


def problems(config):
    with pytest.raises(BadOptions) as refused:
        read_config(config)
    return str(refused.value).splitlines()


def test_what_is_not_there_has_its_default():
    assert read_config({}) == {name: cls() for name, cls in SECTIONS.items()}
    assert read_config({"peaks": None, "advanced": None, "export": {}}) == read_config({})


def test_a_section_is_read_from_both_tiers():
    read = read_config({"peaks": {"floor_mm": 3}, "advanced": {"peaks": {"context_s": 0.1, "paper": {"window_s": 1}}}})
    assert (read["peaks"].floor_mm, read["peaks"].context_s) == (3.0, 0.1)
    assert (read["peaks"].paper.window_s, read["peaks"].paper.scale_estimator) == (1.0, "std")
    assert read["steps"] == SECTIONS["steps"]()


def test_shared_options_reach_the_stages_that_read_them():
    given = {"protect": ["A*"], "advanced": {"predictors": {"local_ridge": {"anchors": 4}}}}
    read = read_config(given)
    assert read["repair"].protect == read["fill"].protect == ("A*",)
    assert all(read[name].predictors.local_ridge.anchors == 4 for name in ("frozen", "peaks", "slow", "repair", "fill"))


def test_a_config_is_written_as_it_was_read():
    read = read_config({"fill": {"max_gap_s": None}, "advanced": {"slow": {"local_ridge_changes": {"inputs": 9}}}})
    assert read_config(write_config(read)) == read
    assert write_config(read)["fill"]["max_gap_s"] is None


def test_about_fifty_options_are_for_laboratories():
    laboratory = [option for name in SECTIONS for option in own_options(name) if option.laboratory]
    assert 40 <= len(laboratory) <= 55


@pytest.mark.parametrize(
    ("config", "words"),
    [
        ({"fill": {"max_gap_s": "0.2 s"}}, "fill.max_gap_s: '0.2 s' is not a number of seconds, such as 2"),
        ({"fill": {"max_error_mm": "5"}}, "fill.max_error_mm: '5' is not a number of millimetres, such as 50"),
        ({"fill": {"fill_ends": 1}}, "fill.fill_ends: 1 is not true or false, such as false"),
        ({"frozen": {"min_frames": True}}, "frozen.min_frames: True is not a whole number, such as 4"),
        ({"frozen": {"min_frames": 1}}, "frozen.min_frames: 1 is out of bounds; it must be at least 2"),
        ({"peaks": {"max_duration_s": 0}}, "peaks.max_duration_s: 0 is out of bounds; it must be above 0 s"),
        ({"peaks": {"preset": "mine"}}, "peaks.preset: 'mine' is none of default, coordinates, paper"),
        ({"slow": {"durations_s": 2}}, "slow.durations_s: 2 is not a list of numbers of seconds, such as [0.25, "),
        ({"slow": {"durations_s": []}}, "slow.durations_s: it must not be empty"),
        ({"slow": {"durations_s": [1, 0]}}, "slow.durations_s[1]: 0 is out of bounds; it must be above 0 s"),
        ({"fill": {"max_gap_s_of": {"A": "x"}}}, "fill.max_gap_s_of.A: 'x' is not a number of seconds, such as 0.5"),
        ({"fill": {"max_gap_s": float("nan")}}, "fill.max_gap_s: nan is not a finite number"),
        ({"ingest": {"static_names": ["("]}}, "ingest.static_names[0]: '(' is not a regular expression"),
        ({"detect": ["peaks", "peaks"]}, "detect: 'peaks' is there twice"),
        ({"detect": ["swaps"]}, "detect[0]: 'swaps' is none of labels, frames, frozen"),
        (
            {"advanced": {"predictors": {"bolero": {"tolerance": "1e-6"}}}},
            "advanced.predictors.bolero.tolerance: '1e-6' is not a number, such as 0.0001",
        ),
        (
            {"fill": {"max_error_mm": "5"}},
            "fill.max_error_mm: '5' is not a number of millimetres, such as 50; write 5 without",
        ),
        (
            {"fill": {"fill_ends": "true"}},
            "fill.fill_ends: 'true' is not true or false, such as false; write true without",
        ),
        ({"fill": {"min_seen_share": 30}}, "fill.min_seen_share: 30 is out of bounds; it must be at most 1"),
        ({"fill": {"max_altered_share": 25}}, "fill.max_altered_share: 25 is out of bounds; it must be at most 1"),
        ({"repair": {"max_altered_share": 10}}, "repair.max_altered_share: 10 is out of bounds; it must be at most 1"),
        ({"fill": {"members": []}}, "fill.members: it must not be empty"),
        ({"fill": {"members": ["spline", "spline"]}}, "fill.members: 'spline' is there twice"),
        ({"protect": "LASI"}, "protect: 'LASI' is not a list of texts, such as [\"LASI\"]"),
        ({"results": ""}, "results: it must not be empty"),
        ({"qc": 3}, "qc: 3 is not a mapping of keys to values"),
        ({"peeks": {}}, "peeks: there is no such key; did you mean peaks?"),
        ({"fill": {"max_gaps_s": 1}}, "fill.max_gaps_s: there is no such key; did you mean max_gap_s?"),
        ({"repair": {"methods": {"peak": []}}}, "repair.methods.peak: there is no such key; did you mean peaks?"),
        ({"peaks": {"sigmas": 7}}, "peaks.sigmas: there is no such key; did you mean threshold_sigmas?"),
        ({"steps": {"min_duration_s": 3}}, "steps: min_duration_s 3 is above max_duration_s 2"),
        (
            {"advanced": {"predictors": {"msvd": {"max_training_frames": 50}}}},
            "advanced.predictors.msvd: min_training_frames 60 is above max_training_frames 50",
        ),
        ({"swaps": {}}, "swaps: its options are now in labels"),
        ({"peaks": {"context_s": 1}}, "peaks.context_s: this is now advanced.peaks.context_s"),
        ({"advanced": {"peaks": {"floor_mm": 1}}}, "advanced.peaks.floor_mm: this is now peaks.floor_mm"),
        ({"advanced": {"fill": {"ensemble": {"radius": {"inner": 4}}}}}, "advanced.fill.ensemble.radius: radii: 0 < "),
    ],
    ids=str,
)
def test_a_refusal_names_the_key_and_what_would_do(config, words):
    (problem,) = problems(config)
    assert problem.startswith(words)


def test_all_problems_are_named_at_once():
    assert (
        len(problems({"fill": {"max_gap_s": "x", "ends": True}, "qc": {"plots": -1}, "advanced": {"fills": {}}})) == 4
    )


@pytest.mark.parametrize(
    ("wrong", "words"),
    [({"input": 8}, "there is no such key; did you mean inputs?"), ({"anchors": 2}, "it must be at least 3")],
)
@pytest.mark.parametrize(
    ("section", "keys"),
    [
        ("slow", lambda wrong: {"local_ridge_changes": wrong}),
        ("repair", lambda wrong: {"separation": {"local_ridge_changes": [{}, wrong]}}),
        ("predictors", lambda wrong: {"local_ridge_variants": {"other": wrong}}),
    ],
)
def test_changes_to_the_local_ridge_are_held_to_its_options(section, keys, wrong, words):
    (problem,) = problems({"advanced": {section: keys(wrong)}})
    assert words in problem


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("peaks.default.sigmas", "peaks.threshold_sigmas"),
        ("steps.default.alike", "advanced.steps.jump_mismatch_fraction"),
        ("fill.ends", "fill.fill_ends"),
        ("fill.ensemble.longest_s", "advanced.fill.ensemble.max_gap_s_of_member"),
        ("fill.variants", "advanced.predictors.local_ridge_variants"),
        ("local_ridge.frames", "advanced.predictors.local_ridge.max_training_frames"),
        ("swaps.floor_mm", "labels.floor_mm"),
        ("mesh.component_cost", "advanced.mesh.max_edge_cost_mm"),
    ],
)
def test_an_old_key_is_refused_with_its_new_name(old, new):
    config = value = {}
    *parents, last = old.split(".")
    for parent in parents:
        value = value.setdefault(parent, {})
    value[last] = 1
    assert problems(config) == [f"{old}: this is now {new}"]


@pytest.mark.parametrize("section", RENAMED)
def test_every_new_name_is_there(section):
    for old in RENAMED[section][1]:
        assert find_place(renamed(f"{section}.{old}")), f"{section}.{old}"


def test_limits_that_reasons_name_are_keys():
    moved = {
        name
        for path in (PROJECT / "scripts/markermend").rglob("*.py")
        for name in re.findall(r'Limit\(\s*"([\w.]+)"', path.read_text(encoding="utf-8"))
    }
    assert moved and all(find_place(name.removeprefix("advanced.")) == name for name in moved)


def test_the_shipped_config_holds_every_default():
    shipped = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))
    assert write_config(read_config({})) == shipped


def test_former_and_unknown_keys_are_all_named():
    assert problems({"peaks": {"default": {"sigmas": 7, "nope": 1}}}) == [
        "peaks.default.sigmas: this is now peaks.threshold_sigmas",
        "peaks.default.nope: there is no such key",
    ]


@pytest.mark.parametrize(
    "config", [{"advanced": None}, write_config(read_config({})), {"peaks": None}], ids=["none", "all", "peaks"]
)
def test_what_is_left_out_gives_the_flags_of_its_default_written_out(config):
    """Otherwise an empty `advanced:` in a user's file would rerun every stage."""
    written, left_out = read_config(config), read_config({})
    assert {name: write_flags(own) for name, own in written.items()} == {
        name: write_flags(own) for name, own in left_out.items()
    }
