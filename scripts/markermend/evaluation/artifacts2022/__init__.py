"""The experiments of the artifact detection paper (skurowski2022)."""
