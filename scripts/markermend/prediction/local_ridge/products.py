"""Weighted sums of products of rows, from which regressions follow that leave blocks of rows out."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.prediction.local_ridge.ridge import solve


@dataclass(frozen=True, eq=False)
class Products:
    """Weighted sums of products of the columns and targets of rows, and their weighted sums over groups of rows.

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
    group_columns, group_target : np.ndarray
        Sums of the columns (..., g, c) and of the targets (..., g, 3) over each group.
    group_total : np.ndarray
        Sums of the weights (..., g) over each group.
    """

    gram: np.ndarray
    cross: np.ndarray
    square: np.ndarray
    total: np.ndarray
    group_columns: np.ndarray
    group_target: np.ndarray
    group_total: np.ndarray

    @classmethod
    def of(
        cls, columns: np.ndarray, target: np.ndarray, weights: np.ndarray, group: np.ndarray, *, groups: int
    ) -> Products:
        """Sum over rows.

        Parameters
        ----------
        columns, target : np.ndarray
            Columns (n, c) and targets (n, 3) of the rows.
        weights : np.ndarray
            Weights of the rows (n,).
        group : np.ndarray
            Number of the group of each row (n,), ascending; it does not count where there are no groups.
        groups : int
            Number of groups, 0 for none.

        Returns
        -------
        Products
            The sums.
        """
        weighted, scale = columns * weights[:, None], weights[:, None]
        starts = starts_of(group) if groups and len(group) else np.zeros(0, int)
        sums = [np.zeros((groups, each.shape[1])) for each in (columns, target, scale)]
        if len(starts):
            for into, each in zip(sums, (weighted, target * scale, scale), strict=True):
                into[group[starts]] = np.add.reduceat(each, starts)
        square = (scale * target**2).sum()
        return cls(weighted.T @ columns, weighted.T @ target, square, weights.sum(), sums[0], sums[1], sums[2][:, 0])

    @classmethod
    def by_block(cls, block: np.ndarray, groups: int, *rows: np.ndarray) -> Products:
        """Sum over each block of rows.

        Parameters
        ----------
        block : np.ndarray
            Block of each row (n,), ascending numbers.
        groups : int
            Number of groups, 0 for none.
        *rows : np.ndarray
            Columns, targets, weights and groups of the rows: see `of`.

        Returns
        -------
        Products
            The sums, first axis: blocks.
        """
        cuts = starts_of(block)[1:]
        parts = zip(*(np.split(each, cuts) for each in rows), strict=True)
        sums = [vars(cls.of(*part, groups=groups)).values() for part in parts]
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

    def less(self, part: Products) -> Products:
        """Take a part of the rows away.

        Parameters
        ----------
        part : Products
            Sums over these rows.

        Returns
        -------
        Products
            Sums over the others.
        """
        return Products(*(whole - own for whole, own in zip(vars(self).values(), vars(part).values(), strict=True)))

    def about_means(self, share: float) -> Products:
        """Take the rows of each group about a share of their weighted mean, whichever rows are left in it.

        Parameters
        ----------
        share : float
            The share.

        Returns
        -------
        Products
            The sums of products of these rows; sums over groups remain.
        """
        if not share or not self.group_total.shape[-1]:
            return self
        taken = share * (2 - share) / np.where(self.group_total > 0, self.group_total, np.inf)
        weighted = (taken[..., None] * self.group_columns).swapaxes(-1, -2)
        square = (taken[..., None] * self.group_target**2).sum(axis=(-2, -1))
        return replace(
            self,
            gram=self.gram - weighted @ self.group_columns,
            cross=self.cross - weighted @ self.group_target,
            square=self.square - square,
        )

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
