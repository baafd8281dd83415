"""The options of the networks, apart from torch, which only their training imports."""

from __future__ import annotations
