"""Numerical methods over arrays that know nothing of markers or files."""
