"""The options: their names, types, bounds, units, defaults and texts."""
