"""The classes of artifacts, one detector each, in their strict order."""

from __future__ import annotations

CLASSES = ("frozen", "tails", "peaks", "noise", "steps", "slow")
"""The detectors in their strict order; each is a stage, and its file holds the class."""
