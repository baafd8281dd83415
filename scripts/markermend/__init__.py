"""Mends the marker trajectories of optical motion capture: pure functions over arrays, one module per concept."""

import os

__version__ = "0.1.0"

# The threads that it is given and no more: without a word one, as in the workflow, so that a command pasted elsewhere
# gives the same bytes (sums over threads differ in the last bits). Must stand before numpy is imported.
for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
