"""Naive twin of the search for lasting displacements: every course is a column of a regression of its own."""

import numpy as np


def explained(local, pose, course, weights, *, ridge):
    """What a course explains of the weighted squares, and its displacement: two whole ridge regressions are compared."""

    def squares(columns):
        design = np.column_stack([np.ones(len(local)), pose, *columns])
        penalty = np.zeros(design.shape[1])
        penalty[1 : 1 + pose.shape[1]] = ridge * weights.sum()
        beta = np.linalg.solve(
            design.T @ (weights[:, None] * design) + np.diag(penalty), design.T @ (weights[:, None] * local)
        )
        error = local - design @ beta
        return (weights[:, None] * error**2).sum() + (penalty[:, None] * beta**2).sum(), beta[-1]

    without, _ = squares([])
    with_course, vector = squares([course])
    return without - with_course, without, vector
