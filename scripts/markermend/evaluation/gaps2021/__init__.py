"""The experiment of the gap reconstruction paper (skurowski2021)."""
