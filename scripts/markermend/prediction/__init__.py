"""Predictors: where a marker should be, given the rest of the body, and how large the error of that is."""
