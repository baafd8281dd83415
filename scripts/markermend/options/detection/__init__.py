"""Options of the detectors, one module per stage."""
