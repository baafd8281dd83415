"""The settings: their names, types, bounds, units, defaults and texts."""
