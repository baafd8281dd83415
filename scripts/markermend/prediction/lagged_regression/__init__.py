"""Predictors by regression on lagged coordinates of the segment mates (skurowski2022 3.3)."""
