"""Predictors by linear dynamical systems."""
