"""Predictors by a matrix of coordinates of low rank."""
