"""Synthetic recordings of a walking person, and known contamination of clean ones."""
