"""The published detectors, which look at each coordinate by itself (skurowski2022)."""
