"""Recordings with a known truth: a synthetic person, and artifacts put into real recordings."""
