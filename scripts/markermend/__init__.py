"""Mends the marker trajectories of optical motion capture: pure functions over arrays, one module per concept."""

__version__ = "0.1.0"
