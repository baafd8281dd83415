"""Predictors by neural networks (skurowski2021)."""
