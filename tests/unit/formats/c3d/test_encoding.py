"""DEC floats are decoded and encoded exactly, and the other processors' by NumPy."""

import struct

import numpy as np
import pytest

from markermend.formats.c3d.encoding import Coding, Processor, decode_dec, encode_dec


def naive_dec(stored):
    """The value of one DEC float by the definition of its fields."""
    low, high = struct.unpack("<HH", stored)
    sign, exponent, fraction = low >> 15, (low >> 7) & 0xFF, ((low & 0x7F) << 16) | high
    if exponent == 0:
        return float("nan") if sign else 0.0
    return (-1) ** sign * (0.5 + fraction / 2**24) * 2.0 ** (exponent - 128)


def test_dec_floats_of_the_manual():
    published = {1.0: 0x00004080, -1.0: 0x0000C080, 3.5: 0x00004160, -3.5: 0x0000C160, 10.0: 0x00004220}
    words = np.array(list(published.values()), "<u4")
    np.testing.assert_array_equal(decode_dec(words), list(published))
    np.testing.assert_array_equal(encode_dec(np.array(list(published))), words)


def test_every_dec_float_is_decoded_as_by_its_definition_and_encoded_back():
    rng = np.random.default_rng(7)
    words = rng.integers(0, 2**32, 3000, dtype=np.uint32).astype("<u4")
    values = decode_dec(words)
    np.testing.assert_array_equal(values, [naive_dec(word.tobytes()) for word in words])
    normal = np.isfinite(values) & (values != 0)
    np.testing.assert_array_equal(encode_dec(values[normal]), words[normal])


def test_dec_rounds_to_the_nearest():
    rng = np.random.default_rng(8)
    values = rng.normal(0, 1000, 2000)
    np.testing.assert_array_equal(decode_dec(encode_dec(values)), values.astype(np.float32).astype(np.float64))


def test_dec_has_no_infinity_and_no_small_numbers():
    values = np.array([np.nan, np.inf, -np.inf, 1e39, -1e39, 0.0, -0.0, 1e-45])
    np.testing.assert_array_equal(decode_dec(encode_dec(values)), [np.nan] * 5 + [0.0] * 3)


@pytest.mark.parametrize("processor", Processor)
def test_floats_of_every_processor_come_back(processor):
    coding = Coding(processor)
    values = np.float32([[0.0, -1.5, 1e-3], [65535.0, -2053.9, 3e7]]).astype(np.float64)
    stored = coding.encode_floats(values)
    assert stored.dtype == coding.float_type
    np.testing.assert_array_equal(coding.decode_floats(stored), values)
    np.testing.assert_array_equal(coding.floats(stored.tobytes()), values.ravel())
