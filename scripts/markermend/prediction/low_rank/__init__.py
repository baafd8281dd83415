"""Predictors by low-rank approximation of the matrix of frames by coordinates."""
