"""Faults of the camera system, which many markers have at once."""
