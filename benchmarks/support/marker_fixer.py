"""Run the marker fixer of AddBiomechanics with ripple reduction on positions in a file; needs nimblephysics and numpy, not markermend.

Reads: an .npz file with positions (frames, markers, 3) in mm and rate in Hz. Writes: another, with the positions after it.

    PYTHON_WITH_NIMBLEPHYSICS benchmarks/support/marker_fixer.py positions.npz fixed.npz
"""

import sys

import nimblephysics
import numpy as np

SOLVER_ITERATIONS = 100000
"""Iterations of its solver, its default."""


def main() -> None:
    read, write = sys.argv[1:]
    given = np.load(read)
    positions, names = given["positions"] / 1000, [f"m{m}" for m in range(given["positions"].shape[1])]
    frames = [
        {name: point for name, point in zip(names, row, strict=True) if not np.isnan(point).any()} for row in positions
    ]
    report = nimblephysics.biomechanics.MarkerFixer.generateDataErrorsReport(
        frames, 1 / float(given["rate"]), False, True, True, True, SOLVER_ITERATIONS
    )
    gone = np.full(3, np.nan)
    fixed = [[frame.get(name, gone) for name in names] for frame in report.markerObservationsAttemptedFixed]
    np.savez(write, positions=1000 * np.array(fixed))


if __name__ == "__main__":
    main()
