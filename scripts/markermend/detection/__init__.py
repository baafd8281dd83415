"""The detectors, one module per class of artifacts."""
