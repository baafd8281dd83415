"""Records of the parameter section are decoded only as far as their lengths allow."""

import pytest

from markermend.formats.c3d.encoding import Coding, Processor
from markermend.formats.c3d.parameter_encoding import encode_record, encode_values
from markermend.formats.c3d.parameter_records import (
    UnsoundRecordError,
    decode_record,
    decode_text,
    decode_values,
)


def test_no_prefix_of_a_record_is_read_beyond_its_end():
    coding = Coding(Processor.INTEL)
    record = encode_record("LABELS", 3, encode_values(["LASI", "RASI"], coding), coding)
    for stop in range(1, len(record)):
        try:
            decoded = decode_record(record[:stop], 0, stop, coding)
        except UnsoundRecordError:
            continue
        assert decoded.following is None
        if decoded.identity:
            with pytest.raises(UnsoundRecordError):
                decode_values(decoded.body[: len(decoded.body) - 2], coding)


def test_text_that_is_not_utf_8_is_latin_1():
    assert (decode_text("Hüfte ".encode()), decode_text("Hüfte\0".encode("latin-1"))) == ("Hüfte", "Hüfte")
