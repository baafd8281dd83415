"""Lasting displacements: markers that stay at, or creep to, another place on their segment."""
