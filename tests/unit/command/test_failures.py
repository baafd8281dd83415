"""Failures are described in one line each."""

import numpy as np
import pytest

from markermend.command.failures import describe


def test_lack_of_memory_is_named_with_or_without_a_size():
    assert describe(MemoryError()).startswith("not enough memory: run fewer recordings at once")
    with pytest.raises(MemoryError) as failure:
        np.empty(2**57)
    assert describe(failure.value).startswith("not enough memory (Unable to allocate 1.00 EiB")


def test_a_file_that_may_not_be_read_is_named():
    error = PermissionError(13, "Permission denied", "/data/walk.c3d")
    assert describe(error) == "/data/walk.c3d cannot be read: permission denied. Allow reading it, and run again"


def test_any_other_failure_has_its_kind_and_one_line():
    assert describe(KeyError("a")) == "KeyError: 'a'"
    assert describe(ValueError("two\nlines")) == "ValueError: two lines"
