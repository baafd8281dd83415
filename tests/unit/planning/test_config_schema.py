"""Values held against schemas: what people read where they do not fit."""

import pytest

from markermend.planning import config_schema
from markermend.planning.recordings import BadDataSet

SCHEMA = """
type: object
additionalProperties: false
properties:
  mesh:
    type: object
    properties: {scale_mm: {type: number, exclusiveMinimum: 0}, frames: {type: integer}}
"""


@pytest.fixture
def schema(tmp_path):
    path = tmp_path / "schema.yaml"
    path.write_text(SCHEMA)
    return path


def test_a_value_that_fits_passes(schema):
    config_schema.check({"mesh": {"scale_mm": 2.5, "frames": 3}}, schema, where="The config")


def test_each_problem_is_one_line_that_begins_with_its_key(schema):
    with pytest.raises(BadDataSet) as caught:
        config_schema.check({"mesh": {"scale_mm": 0, "frames": "a"}, "x": 1}, schema, where="study.yaml")
    first, *lines = str(caught.value).splitlines()
    assert first.startswith("study.yaml cannot be used")
    assert [line.split(":")[0].strip() for line in lines] == ["top level", "mesh.frames", "mesh.scale_mm"]
