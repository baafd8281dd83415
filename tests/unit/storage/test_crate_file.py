"""The checksums that a crate states of files, by their paths; a damaged one is an error."""

import json

import pytest

from markermend.storage import crate_file


def test_files_have_their_paths_and_checksums_and_originals_are_none(tmp_path):
    graph = [
        {"@id": "./", "@type": "Dataset"},
        {"@id": "cleaned/S%202/%C3%A4.trc", "@type": "File", "identifier": "sha256:ab"},
        {"@id": "report/workflow/Snakefile", "@type": ["File", "SoftwareSourceCode"]},
        {"@id": "report/notes.txt", "@type": "File"},
        {"@id": "#original/S01/walk", "@type": "CreativeWork", "identifier": "sha256:cd"},
    ]
    (tmp_path / crate_file.METADATA).write_text(json.dumps({"@graph": graph}))
    assert crate_file.checksums(tmp_path) == {"cleaned/S 2/ä.trc": "ab"}


@pytest.mark.parametrize("content", ["", "{", "[]", "{}", '{"@graph": 7}', '{"@graph": ["File"]}', '{"@graph": [{}]}'])
def test_a_damaged_one_is_an_error(tmp_path, content):
    with pytest.raises(OSError):
        crate_file.checksums(tmp_path)
    (tmp_path / crate_file.METADATA).write_text(content)
    with pytest.raises(ValueError):
        crate_file.checksums(tmp_path)
