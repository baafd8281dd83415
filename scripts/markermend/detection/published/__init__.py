"""Detection coordinate by coordinate, as published (skurowski2022)."""
