"""Parameters that are encoded are decoded to the same values, by records that describe their own length."""

import numpy as np
import pytest

from markermend.formats.c3d.encoding import Coding, Processor
from markermend.formats.c3d.parameter_encoding import encode_record, encode_section, encode_values, padded
from markermend.formats.c3d.parameter_records import decode_record, decode_values
from markermend.formats.c3d.parameters import BLOCK

VALUES = {
    "text": ("LASI", ["LASI"]),
    "texts": (["A", "Bein links", "Hüfte"], ["A", "Bein links", "Hüfte"]),
    "integer": (65535, [65535]),
    "integers": ([3, 2, 1], [3, 2, 1]),
    "real": (0.5, [0.5]),
    "reals": (np.array([[0.0, -1.5], [2.25, 1e6]]), [0.0, 2.25, -1.5, 1e6]),
}


@pytest.mark.parametrize("processor", Processor)
@pytest.mark.parametrize("name", VALUES)
def test_values_and_records_come_back(processor, name):
    coding, (value, expected) = Coding(processor), VALUES[name]
    content = encode_values(value, coding)
    record = encode_record("LABELS", 3, content, coding)
    decoded = decode_record(record + b"\0\0", 0, len(record) + 2, coding)
    assert (decoded.identity, decoded.name, decoded.following) == (3, "LABELS", len(record))
    assert list(decode_values(decoded.body, coding)) == expected
    assert decoded.body == content + b"\0"


def test_long_lists_go_on_in_further_parameters_and_data_start_after_the_section():
    groups = {"POINT": {"LABELS": [f"M{m}" for m in range(600)], "DATA_START": 0}}
    section = encode_section(groups, Coding(Processor.INTEL))
    assert len(section) % BLOCK == 0 and groups["POINT"]["DATA_START"] == 2 + len(section) // BLOCK
    assert section.count(b"LABELS2") == section.count(b"LABELS3") == 1
    assert len(padded(b"x" * 513)) == 1024 and padded(b"") == b""
