"""Slow changes: drifts of a marker and back, in the residual of its prediction."""
