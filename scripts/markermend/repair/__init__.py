"""Repair of what the detectors found."""
