"""Numbers in C3D files: three processors, each with its byte order and its floating point."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


class Processor(enum.IntEnum):
    """The processor that a file was written for, by its code in the parameter section."""

    INTEL = 84
    DEC = 85
    MIPS = 86


@dataclass(frozen=True)
class Coding:
    """How the numbers of one processor are stored, and the conversion from and to float64.

    Attributes
    ----------
    processor : Processor
        The processor that a file was written for.
    """

    processor: Processor

    @property
    def order(self) -> str:
        """The byte order of integers, as NumPy writes it."""
        return ">" if self.processor is Processor.MIPS else "<"

    @property
    def float_type(self) -> np.dtype[Any]:
        """The stored type of a float: raw bits for DEC, which NumPy does not support."""
        return np.dtype("<u4" if self.processor is Processor.DEC else f"{self.order}f4")

    @property
    def integer_type(self) -> np.dtype[Any]:
        """The stored type of a signed 16-bit integer."""
        return np.dtype(f"{self.order}i2")

    def decode_floats(self, stored: np.ndarray) -> np.ndarray:
        """Decode stored floats exactly.

        Parameters
        ----------
        stored : ndarray
            Of float_type, in any shape.

        Returns
        -------
        ndarray of float64
            The values, in the same shape.
        """
        if self.processor is Processor.DEC:
            return decode_dec(stored)
        with np.errstate(invalid="ignore"):  # a signalling NaN is a NaN
            return stored.astype(np.float64)

    def encode_floats(self, values: np.ndarray) -> np.ndarray:
        """Encode values as floats, to the nearest.

        Parameters
        ----------
        values : ndarray of float64
            In any shape.

        Returns
        -------
        ndarray
            Of float_type, in the same shape; what is too large becomes NaN or infinite.
        """
        if self.processor is Processor.DEC:
            return encode_dec(values)
        with np.errstate(over="ignore"):
            return values.astype(self.float_type)

    def encode_integers(self, values: ArrayLike) -> np.ndarray:
        """Encode 16-bit integers.

        Parameters
        ----------
        values : array_like
            Signed or unsigned.

        Returns
        -------
        ndarray of uint16
            In the byte order of the processor, in the same shape.
        """
        return np.asarray(np.asarray(values, np.int64) & 0xFFFF, f"{self.order}u2")

    def integers(self, data: bytes) -> np.ndarray:
        """Decode bytes as unsigned 16-bit integers.

        Parameters
        ----------
        data : bytes
            The bytes.

        Returns
        -------
        ndarray of uint16
            The integers.
        """
        return np.frombuffer(data, f"{self.order}u2")

    def floats(self, data: bytes) -> np.ndarray:
        """Decode bytes as floats.

        Parameters
        ----------
        data : bytes
            The bytes.

        Returns
        -------
        ndarray of float64
            The values.
        """
        return self.decode_floats(np.frombuffer(data, self.float_type))


def decode_dec(stored: np.ndarray) -> np.ndarray:
    """Decode DEC (VAX F) floats exactly.

    The sixteen bits with sign and exponent come first. The value is 0.1mmm (binary) times 2**(exponent - 128);
    exponent 0 means zero, or NaN where the sign is set.

    Parameters
    ----------
    stored : ndarray of uint32
        Little-endian 32-bit words.

    Returns
    -------
    ndarray of float64
        The values, in the same shape.
    """
    bits = stored.astype(np.uint32)
    bits = (bits >> np.uint32(16)) | (bits << np.uint32(16))
    exponent = ((bits >> np.uint32(23)) & np.uint32(0xFF)).astype(np.int32)
    negative = (bits >> np.uint32(31)).astype(bool)
    fraction = ((bits & np.uint32(0x7FFFFF)) | np.uint32(0x800000)).astype(np.float64)
    size = np.where(exponent == 0, np.where(negative, np.nan, 0.0), np.ldexp(fraction, exponent - (128 + 24)))
    return np.where(negative, -size, size)


def encode_dec(values: np.ndarray) -> np.ndarray:
    """Encode values as DEC (VAX F) floats, to the nearest.

    Parameters
    ----------
    values : ndarray of float64
        Of any shape.

    Returns
    -------
    ndarray of uint32
        Little-endian 32-bit words. What is too large, infinite or NaN becomes the reserved operand, which reads as
        NaN; what is too small becomes zero.
    """
    finite = np.isfinite(values)
    fraction, exponent = np.frexp(np.where(finite, np.abs(values), 0.0))
    whole = np.rint(np.ldexp(fraction, 24)).astype(np.int64)
    carried = whole == 1 << 24
    whole = np.where(carried, 1 << 23, whole)
    exponent = exponent.astype(np.int64) + carried + 128
    sign = np.signbit(values).astype(np.int64) << 31
    bits = sign | (exponent << 23) | (whole & 0x7FFFFF)
    bits = np.where((whole == 0) | (exponent <= 0), 0, bits)
    bits = np.where(~finite | (exponent > 255), 1 << 31, bits)
    return ((bits >> 16) | ((bits & 0xFFFF) << 16)).astype("<u4")
