"""Names of result files are an interface for users' scripts."""

from markermend.core.artifacts import BY_STAGE
from markermend.planning.result_files import ResultFiles

FILES = ResultFiles("/out")


def test_names_that_users_scripts_rely_on():
    names = {
        name: getattr(FILES, name)
        for name in (
            "markers",
            "repaired",
            "repairs",
            "filled",
            "changes",
            "change_table",
            "originals",
            "certificate",
            "quality",
        )
    }
    assert names == {
        "markers": "/out/{subject}/{recording}/01_markers.parquet",
        "repaired": "/out/{subject}/{recording}/06_repaired.parquet",
        "repairs": "/out/{subject}/{recording}/06_changes.parquet",
        "filled": "/out/{subject}/{recording}/07_filled.parquet",
        "changes": "/out/{subject}/{recording}/07_changes.parquet",
        "change_table": "/out/{subject}/{recording}/changes.tsv",
        "originals": "/out/{subject}/{recording}/originals.parquet",
        "certificate": "/out/{subject}/{recording}/certificate.json",
        "quality": "/out/{subject}/{recording}/08_qc.json",
    }
    assert FILES.mesh == "/out/{subject}/mesh.json" and FILES.report == "/out/report"


def test_each_detector_has_an_events_file_of_its_own():
    assert list(FILES.events) == list(BY_STAGE)
    assert len(set(FILES.events.values())) == len(BY_STAGE)
    assert FILES.events["peaks"] == "/out/{subject}/{recording}/02_peaks.parquet"
    assert FILES.events["slow"] == "/out/{subject}/{recording}/05_slow.parquet"
