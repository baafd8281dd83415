"""What not every system has."""

import os

import pytest

posix = pytest.mark.skipif(
    os.name != "posix", reason="Windows has no pipes and sockets in folders, and links need rights"
)
"""Tests of what only a POSIX file system has."""
