"""Changes go through their file unharmed, whatever is and is not known of them."""

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.core.changes import Alternative, Change, MemberWeight, Outcome
from markermend.core.reasons import Cause, Limit, Reason
from markermend.core.recording import SetAside
from markermend.storage import change_file, stage_files

names = st.text(st.characters(codec="utf-8"), max_size=8)
sizes = st.none() | st.floats(allow_nan=False)
numbers = st.floats(allow_nan=False)
reasons = st.builds(Reason, st.sampled_from(Cause), names, st.none() | st.builds(Limit, names, numbers, numbers))
changes = st.builds(
    Change,
    marker=names,
    start=st.integers(0, 2**40),
    stop=st.integers(0, 2**40),
    classes=st.lists(names, max_size=3).map(tuple),
    outcome=st.sampled_from(Outcome),
    score=sizes,
    axes=st.sampled_from(["", "xz", "xyz"]),
    partner=st.none() | names,
    method=st.none() | names,
    alternatives=st.lists(st.builds(Alternative, names, numbers), max_size=3).map(tuple),
    member_weights=st.lists(st.builds(MemberWeight, names, numbers), max_size=3).map(tuple),
    samples=st.integers(0, 2**40),
    largest_change_mm=sizes,
    expected_error_mm=sizes,
    expected_error95_mm=sizes,
    decisions=st.lists(names, max_size=2).map(tuple),
    reason=st.none() | reasons,
)


@given(st.lists(changes, max_size=4))
def test_what_is_written_is_read(tmp_path_factory, some):
    path = tmp_path_factory.mktemp("changes") / "06_changes.parquet"
    change_file.write(path, some, {"stage": "repair"})
    assert change_file.read(path) == tuple(some)
    assert stage_files.read_facts(path) == {"stage": "repair"}


def test_columns_are_typed_even_where_all_is_unknown(tmp_path):
    for some in ([], [Change("A", 0, 1, ("gap",), Outcome.LEFT)]):
        change_file.write(tmp_path / "some.parquet", some, {})
        assert pq.read_schema(tmp_path / "some.parquet").remove_metadata() == change_file.SCHEMA
    assert pa.types.is_struct(change_file.SCHEMA.field("alternatives").type.value_type)


def test_equal_changes_give_equal_bytes(tmp_path):
    some = [Change("A", 0, 1, ("peak", "slow"), Outcome.BLANKED, 2.5, reason=Reason(Cause.SEVERAL_CLASSES, "two"))]
    for name in ("one", "other"):
        change_file.write(tmp_path / name, some, {"stage": "repair"})
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()


def test_a_recording_that_was_set_aside_has_no_changes_to_read(tmp_path):
    stage_files.set_aside(tmp_path / "06_changes.parquet", "ingest", "no C3D file")
    with pytest.raises(SetAside, match="no C3D file"):
        change_file.read(tmp_path / "06_changes.parquet")
