"""Weighted sums of products of rows, from which regressions follow that leave blocks of rows out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.prediction.local_ridge.ridge import solve


@dataclass(frozen=True, eq=False)
class Products:
    """Weighted sums of products of the columns and targets of rows.

    Attributes
    ----------
    gram : np.ndarray
        Of the columns (..., c, c).
    cross : np.ndarray
        Of the columns and the targets (..., c, 3).
    square : np.ndarray
        Of the targets with themselves (...).
    total : np.ndarray
        Sums of the weights (...).
    """

    gram: np.ndarray
    cross: np.ndarray
    square: np.ndarray
    total: np.ndarray

    @classmethod
    def of(cls, columns: np.ndarray, target: np.ndarray, weights: np.ndarray) -> Products:
        """Sum over rows.

        Parameters
        ----------
        columns, target : np.ndarray
            Columns (n, c) and targets (n, 3) of the rows.
        weights : np.ndarray
            Weights of the rows (n,).

        Returns
        -------
        Products
            The sums.
        """
        weighted = (columns * weights[:, None]).T
        square = (weights[:, None] * target**2).sum()
        return cls(weighted @ columns, weighted @ target, square, weights.sum())

    @classmethod
    def by_block(cls, columns: np.ndarray, target: np.ndarray, weights: np.ndarray, block: np.ndarray) -> Products:
        """Sum over each block of rows.

        Parameters
        ----------
        columns, target : np.ndarray
            Columns (n, c) and targets (n, 3) of the rows.
        weights : np.ndarray
            Weights of the rows (n,).
        block : np.ndarray
            Block of each row (n,), ascending numbers.

        Returns
        -------
        Products
            The sums, first axis: blocks.
        """
        cuts = starts_of(block)[1:]
        parts = zip(*(np.split(each, cuts) for each in (columns, target, weights)), strict=True)
        sums = [vars(cls.of(*part)).values() for part in parts]
        return cls(*(np.stack(each) for each in zip(*sums, strict=True)))

    def sum(self) -> Products:
        """Sum over all blocks.

        Returns
        -------
        Products
            The sums.
        """
        return Products(*(each.sum(axis=0) for each in vars(self).values()))

    def others(self) -> Products:
        """Sum for each block over all other blocks.

        Returns
        -------
        Products
            The sums, first axis: blocks.
        """
        return Products(*(each.sum(axis=0) - each for each in vars(self).values()))

    def exchange(self, part: Products, other: Products) -> Products:
        """Put other rows in the place of a part of the rows.

        Parameters
        ----------
        part, other : Products
            Sums over the rows to take away, and over those to add.

        Returns
        -------
        Products
            The sums.
        """
        terms = zip(vars(self).values(), vars(part).values(), vars(other).values(), strict=True)
        return Products(*(whole - taken + added for whole, taken, added in terms))

    def coefficients(self, penalty: np.ndarray, pooled: Products | None = None, weight: float = 0.0) -> np.ndarray:
        """Solve for the coefficients of a ridge regression.

        Parameters
        ----------
        penalty : np.ndarray
            Penalties of the columns (c,) per unit of weight.
        pooled : Products, optional
            Sums over pooled rows.
        weight : float
            Weight of all pooled rows together, in units of that of these rows.

        Returns
        -------
        np.ndarray
            Coefficients (..., c, 3).
        """
        gram, cross, total = self.gram, self.cross, self.total
        if pooled is not None and weight > 0:
            scale = (weight * total / pooled.total)[..., None, None]
            gram, cross, total = gram + scale * pooled.gram, cross + scale * pooled.cross, (1 + weight) * total
        return solve(gram, cross, total, penalty)

    def square_error(self, coefficients: np.ndarray) -> float:
        """Sum the squared errors of coefficients over all rows.

        Parameters
        ----------
        coefficients : np.ndarray
            Coefficients (..., c, 3) for each block.

        Returns
        -------
        float
            Weighted sum of the squared errors.
        """
        explained = (coefficients * (2 * self.cross - self.gram @ coefficients)).sum(axis=(-2, -1))
        return float((self.square - explained).sum())


def starts_of(block: np.ndarray) -> np.ndarray:
    """Find the first row of each block.

    Parameters
    ----------
    block : np.ndarray
        Block of each row (n,), ascending numbers.

    Returns
    -------
    np.ndarray
        Indices (blocks,).
    """
    return np.flatnonzero(np.diff(block, prepend=block[0] - 1))
