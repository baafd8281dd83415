"""Predictors by linear dynamical systems: Kalman smoothing in a low-dimensional space of poses or of hidden states."""
