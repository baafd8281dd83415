"""Numerical methods on arrays, independent of markers, recordings and files."""
