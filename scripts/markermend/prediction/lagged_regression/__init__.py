"""Regressions of a marker on the present and past laboratory coordinates of its segment mates (skurowski2022)."""
