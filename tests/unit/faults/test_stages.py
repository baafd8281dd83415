"""Results as they are before a stage."""

from faults.stages import STAGES, remove_from
from markermend.core.artifacts import DETECTORS
from markermend.storage import output_checksums


def test_every_detector_is_a_stage_in_its_order():
    assert [stage for stage in STAGES if stage in DETECTORS] == list(DETECTORS)


def test_what_a_stage_and_those_after_it_wrote_is_removed(tmp_path):
    for stage, name in {
        "mesh": "S01/mesh.json",
        "ingest": "S01/walk/01.parquet",
        "repair": "S01/walk/06.parquet",
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name)
        output_checksums.write(stage, [path])
    remove_from("poses", tmp_path)
    assert (tmp_path / "S01/walk/06.parquet").exists()
    remove_from("mesh", tmp_path)
    assert [path.name for path in tmp_path.glob("**/*.parquet")] == ["01.parquet"] and not (
        tmp_path / "S01/mesh.json"
    ).exists()
