"""The experiments of the three papers, and the measures that they state."""
