"""The experiments of the published papers, and the measures that they state."""
