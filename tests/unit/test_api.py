"""The chain in one process: what each function gives, and the example that people read."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.core.artifacts import DETECTORS
from markermend.core.changes import Outcome
from markermend.core.recording import Restored
from markermend.options.reader import BadOptions
from support.paths import PROJECT
from support.workflow_runs import write_recording


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A small recording with a gap of M1 in frames 41 to 50 and a peak of M2 in frame 81."""
    path = tmp_path_factory.mktemp("S01") / "walk.c3d"
    write_recording(path, seed=1)
    return path


@pytest.fixture(scope="module")
def recording(path):
    return api.read(path)


@pytest.fixture(scope="module")
def cleaned(recording):
    return api.clean(recording)


def test_the_detectors_are_all_classes_of_artifacts():
    assert tuple(api.DETECTORS) == DETECTORS


def test_a_recording_is_named_after_its_file_and_folder(path, recording):
    assert recording.facts["recording"] == "walk" and recording.facts["subject"] == path.parent.name
    named = api.read(path, subject="Bob", recording="1", kind="static", rate=50)
    assert [named.facts[name] for name in ("subject", "recording", "kind")] == ["Bob", "1", "static"]
    assert named.rate == 50 and recording.rate == 100


def test_cleaning_is_its_stages_one_after_the_other(recording, cleaned):
    mesh = api.infer_mesh([recording])
    findings = api.detect(recording, mesh)
    repaired = api.repair(recording, mesh, findings)
    filled = api.fill(repaired, mesh)
    assert mesh == cleaned.mesh and findings == cleaned.findings and tuple(filled.changes) == tuple(cleaned.changes)
    assert np.array_equal(filled.recording.positions, cleaned.recording.positions, equal_nan=True)


@pytest.fixture(scope="module")
def subject(tmp_path_factory):
    """Three recordings of one subject: two that move, and a static one."""
    folder = tmp_path_factory.mktemp("S02")
    for name in ("walk", "jump", "static"):
        write_recording(folder / f"{name}.c3d", seed=4)
    kinds = {"static": "static"}
    return [api.read(path, kind=kinds.get(path.stem, "auto")) for path in sorted(folder.glob("*.c3d"))]


def test_a_subject_is_cleaned_as_its_recordings_one_after_the_other_with_their_poses(subject):
    together = api.clean_subject(subject)
    mesh = api.infer_mesh(subject)
    poses = api.sample_poses([api.repair(own, mesh, api.detect(own, mesh)) for own in subject[::-1]], mesh)
    assert poses.recordings == ("jump", "walk")
    assert [own.recording.facts.get("learned_from") for own in together] == [["walk"], None, ["jump"]]
    for own, cleaned in zip(subject, together, strict=True):
        by_itself = api.clean(own, mesh, poses=poses)
        assert np.array_equal(by_itself.recording.positions, cleaned.recording.positions, equal_nan=True)
        assert by_itself.changes == cleaned.changes and cleaned.measured is own


def test_without_pooling_recordings_are_filled_from_themselves(subject):
    options = api.Options.read({"fill": {"pool": False}})
    alone = api.clean(subject[0], api.infer_mesh(subject))
    together = api.clean_subject(subject, options=options)[0]
    assert np.array_equal(alone.recording.positions, together.recording.positions, equal_nan=True)
    assert "learned_from" not in together.recording.facts


def test_two_recordings_of_one_name_are_refused(subject):
    jump = subject[0]
    with pytest.raises(ValueError, match="two recordings have one name: jump, jump"):
        api.clean_subject([jump, jump])


def test_decisions_on_a_subject_are_told_apart_by_recording(subject):
    decisions = {"walk": [{"marker": "M1", "decision": "reject", "value": "gap"}]}
    cleaned = api.clean_subject(subject, decisions=decisions)
    m = subject[0].markers.index("M1")
    assert [own.recording.missing[40:50, m].any() for own in cleaned] == [False, True, True]


def test_the_input_is_not_modified_and_the_gap_and_the_peak_are_gone(path, recording, cleaned):
    assert np.array_equal(recording.positions, api.read(path).positions, equal_nan=True)
    assert isinstance(cleaned.recording, Restored) and not cleaned.recording.missing.any()
    places = {(change.marker, change.start, change.stop) for change in cleaned.changes}
    assert {("M1", 40, 50), ("M2", 80, 81)} <= places


def test_only_the_classes_that_are_asked_for_are_looked_for(recording, cleaned):
    options = api.Options.read({"detect": ["peaks"]})
    assert list(api.detect(recording, cleaned.mesh, options)) == ["peaks"]
    untouched = api.clean(recording, cleaned.mesh, api.Options.read({"detect": [], "fill": {"max_gap_s": 0.01}}))
    assert np.array_equal(untouched.recording.positions, recording.positions, equal_nan=True)


def test_options_that_cannot_be_used_are_refused():
    assert api.Options.read() == api.Options.read({})
    with pytest.raises(BadOptions, match="max_gap_s"):
        api.Options.read({"fill": {"max_gap": 0.2}})


def test_a_person_decides(recording, cleaned):
    decisions = [
        {"marker": "M1", "decision": "reject", "value": "gap"},
        {"marker": "M2", "decision": "reject", "first_frame": 81, "last_frame": 81},
    ]
    decided = api.clean(recording, cleaned.mesh, decisions=decisions)
    assert np.isnan(decided.recording.positions[40:50, 1]).all()
    assert np.array_equal(decided.recording.positions[80, 2], recording.positions[80, 2])
    assert all(change.outcome is Outcome.LEFT for change in decided.changes if change.marker in ("M1", "M2"))


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ({"decision": "rejct"}, "decision 2, column decision: 'rejct' is none of .* did you mean 'reject'"),
        ({"value": "swp"}, "decision 2, column value: 'swp' is none of .* did you mean 'swap'"),
        ({"first_fame": 3}, "decision 2: there is no 'first_fame'; did you mean first_frame"),
        ({"first_frame": 3}, "decision 2, column last_frame: is empty"),
        ({"decision": "accept", "marker": "M*"}, "lines 1 and 2 contradict each other"),
    ],
)
def test_decisions_that_cannot_be_meant_are_refused(recording, cleaned, line, words):
    decisions = [{"marker": "M1", "decision": "reject"}, {"marker": "M1", "decision": "reject", **line}]
    with pytest.raises(BadOptions, match=words):
        api.clean(recording, cleaned.mesh, decisions=decisions)


def test_frames_of_a_decision_may_be_texts_or_empty(recording):
    line = {"marker": "M1", "decision": "reject"}
    [decision] = api.read_decisions([{**line, "first_frame": "3", "last_frame": 4.0, "note": None}], recording)
    assert (decision.start, decision.stop) == (3 - recording.first_frame, 5 - recording.first_frame)
    whole = api.read_decisions([{**line, "first_frame": None, "last_frame": ""}], recording)
    assert whole == api.read_decisions([line], recording)


def test_the_original_is_never_overwritten(cleaned, tmp_path):
    original = tmp_path / "walk.c3d"
    for copy in (original, tmp_path / "x" / ".." / "walk.c3d"):
        with pytest.raises(ValueError, match="is the original"):
            api.write(cleaned, original, copy)
    with pytest.raises(ValueError, match=r"name it \*\.c3d"):
        api.write(cleaned, original, tmp_path / "walk.trc")


def test_recordings_of_unlike_marker_sets_need_several_meshes(recording, tmp_path):
    other = api.read(path_of_others(tmp_path))
    with pytest.raises(ValueError, match=r"these recordings need 2 meshes, .*: .*walk"):
        api.infer_mesh([recording, other])
    with pytest.raises(ValueError, match="the mesh lacks A0, A1"):
        api.clean(other, api.infer_mesh([recording]))


def path_of_others(folder):
    """A recording with other markers."""
    from markermend.formats.c3d.writer import Content, write_new

    positions = np.random.default_rng(0).normal(0, 200, (200, 5, 3)).cumsum(axis=0) / 20
    write_new(folder / "other.c3d", Content(labels=[f"A{m}" for m in range(5)], positions=positions, rate=100.0))
    return folder / "other.c3d"


def test_a_mesh_of_the_user_wins(recording, tmp_path):
    path = tmp_path / "mesh.json"
    block = {"name": "block", "markers": list(recording.markers), "parent": None, "parent_marker": None}
    path.write_text(json.dumps({"segments": [block]}), encoding="utf-8")
    assert [segment.name for segment in api.infer_mesh([recording], mesh_files=[path]).segments] == ["block"]


def test_a_table_has_a_row_per_frame_and_columns_as_the_files_between_stages(recording, cleaned):
    measured, restored = api.to_dataframe(recording), api.to_dataframe(cleaned.recording)
    assert list(measured.columns[:4]) == ["M0.x", "M0.y", "M0.z", "M1.x"] and measured.index.name == "frame"
    assert measured.index[0] == recording.first_frame and len(measured) == recording.frames
    assert measured["M1.y"].isna().sum() == 10 and measured.loc[81, "M2.z"] == recording.positions[80, 2, 2]
    assert set(restored["M1.origin"].unique()) == {"measured", "filled"}
    assert (restored.loc[41:50, "M1.error95"] > restored.loc[41:50, "M1.error"]).all()


def test_files_are_written_next_to_the_copy(path, cleaned, tmp_path):
    names = {name: tmp_path / name for name in ("changes.tsv", "originals.parquet", "cleaned.c3d")}
    certificate = api.write(
        cleaned, path, names["cleaned.c3d"], changes=names["changes.tsv"], originals=names["originals.parquet"]
    )
    assert certificate["changed_samples"] == 11 and all(file.exists() for file in names.values())
    assert names["changes.tsv"].read_text(encoding="utf-8").count("\n") == 3


def test_the_example_of_the_readme_runs(path, tmp_path, monkeypatch, capsys):
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(example.strip().splitlines()) <= 10
    (tmp_path / "walk.c3d").write_bytes(path.read_bytes())
    write_recording(tmp_path / "turn.c3d", seed=2, body=1)
    monkeypatch.chdir(tmp_path)
    exec(compile(example, "README.md", "exec"), {})
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == ["walk", "turn"] and lines[0] == "walk 11 samples changed"
    ends = (".c3d", "_cleaned.c3d", "_changes.tsv")
    assert {file.name for file in tmp_path.iterdir()} == {f"{name}{end}" for name in ("walk", "turn") for end in ends}


def test_the_detectors_warnings_are_among_those_of_the_result(recording):
    """Every second frame repeats: nothing is done about it, but it is said."""
    still = replace(recording, positions=np.repeat(recording.positions[::2], 2, axis=0))
    assert any(text.startswith("frames repeat regularly") for text in api.clean(still).warnings)
