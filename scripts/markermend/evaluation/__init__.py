"""Measures of the published experiments: errors of filled gaps, information criteria, descriptors of recordings, correlations."""
