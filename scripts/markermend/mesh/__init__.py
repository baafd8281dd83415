"""The functional body mesh: which markers form rigid segments, and how the segments are connected."""
