"""How gaps were filled, in the words of the methods paragraph, from the options that the stage states."""

import json
import shlex

import pytest
import yaml

import fill
from markermend.options.config import read_config
from markermend.options.filling import FillOptions
from markermend.options.flags import write_flags
from markermend.options.values import plain
from markermend.report.methods_filling import WEIGHTS
from markermend.report.methods_text import paragraph
from markermend.storage import change_file, stage_files
from support.fillings import fill_options, restored, rigid_body
from support.paths import PROJECT

NAMES = ("A", "B", "C", "D")


def fill_file(folder, **averaging):
    """The options in the footer of a fill file that the stage wrote."""
    positions = rigid_body(frames=120, markers=4)
    recording = restored(positions, markers=NAMES, recording="walk", kind="dynamic")
    stage_files.write_recording(folder / "06.parquet", recording, {"stage": "repair", "options": {}})
    ranked = {name: [other for other in NAMES if other != name] for name in NAMES}
    body = {"recordings": ["walk"], "markers": NAMES, "segments": [], "predictors": ranked, "neighbours": ranked}
    (folder / "mesh.json").write_text(json.dumps({"meshes": [{**body, "warnings": []}]}))
    options = [*shlex.split(write_flags(fill_options(averaging))), "--decisions=[]"]
    change_file.write(folder / "06_changes.parquet", [], {"stage": "repair"})
    files = ["--repaired", folder / "06.parquet", "--repairs", folder / "06_changes.parquet"]
    files += ["--mesh", folder / "mesh.json", "--poses", "--code", "", "--filled", folder / "07.parquet"]
    files += ["--changes", folder / "07_changes.parquet"]
    fill.main([*map(str, files), *options])
    return stage_files.read_facts(folder / "07.parquet")["options"]


def test_recordings_that_predictors_learned_from_are_stated_only_where_there_are_any():
    sentence = "a sample of the poses in the subject's other recordings"
    assert sentence in paragraph({"fill": {}}, "dynamic", "1.0", pooled=True)["text"]
    assert sentence not in paragraph({"fill": {}}, "dynamic", "1.0")["text"]
    assert sentence not in paragraph({"fill": {}}, "static", "1.0", pooled=True)["text"]


@pytest.mark.parametrize("weights", WEIGHTS)
def test_the_weights_of_a_real_fill_file_are_stated(weights, tmp_path):
    options = fill_file(tmp_path, weights=weights)
    text = paragraph({"fill": options}, "dynamic", "1.0")["text"]
    assert WEIGHTS[weights] in text
    assert not any(other in text for key, other in WEIGHTS.items() if key != weights)
    assert "of at most 2 s, with an expected error of at most 50 mm and with an error of at most" in text
    assert ", ".join(name.replace("_", " ") for name in FillOptions().members) in text
    assert "person" not in text


def test_the_program_of_tits2018_is_described_by_its_constraints():
    config = yaml.safe_load((PROJECT / "config/presets/published_pma_code.yaml").read_text(encoding="utf-8"))
    text = paragraph({"fill": plain(read_config(config)["fill"])}, "dynamic", "1.0")["text"]
    assert "A linear ramp, in the frame of the reference markers where there is one, made each" in text
    assert "its distances to the 3 steadiest markers lie between the 1 and 99 % quantiles" in text
    assert "smoothed by a moving median and a moving mean over 0.07 s" in text
    config["advanced"]["fill"]["ensemble"]["time_constraint"] = "off"
    text = paragraph({"fill": plain(read_config(config)["fill"])}, "dynamic", "1.0")["text"]
    assert "Predictions were not made to meet the samples" in text and "ramp" not in text
