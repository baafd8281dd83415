"""The evidence for other labels over time: how well samples fit under them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from markermend.core.shape import Shape
from markermend.detection.labelling.relabelling import LabelChange, Relabelling
from markermend.detection.labelling.trajectories import LabelledTrajectories
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.shape_evidence import ShapeEvidence


@dataclass(frozen=True)
class LabelEvidence:
    """The samples of some frames under the labels that are supposed to be right, and how well they fit.

    Attributes
    ----------
    rows : np.ndarray
        The frames that are looked at (rows,), ascending.
    spacing_s : float
        Time between most of them, s.
    tracks : LabelledTrajectories
        The trajectories.
    shape : Shape
        The usual distances.
    options : LabelsOptions
        How clear the evidence must be.
    """

    rows: np.ndarray
    spacing_s: float
    tracks: LabelledTrajectories
    shape: Shape
    options: LabelsOptions

    def fit(self, rows: np.ndarray, under: np.ndarray | None = None, *, group: bool = False) -> ShapeEvidence:
        """Judge samples by the shape.

        Parameters
        ----------
        rows : np.ndarray
            Which of the frames, bool (rows,).
        under : np.ndarray | None
            Under which label each marker is (n, markers); by default as it is supposed to be.
        group : bool
            Whether labels of a whole group are judged: most of the usual anchors of its markers are in it, so that there must be
            more of them.

        Returns
        -------
        ShapeEvidence
            The evidence for these labels.
        """
        labels = self.tracks.under[self.rows[rows]] if under is None else under
        shape = self.options.shape
        options = replace(shape, anchors=self.options.group_anchors) if group else shape
        recorded = self.tracks.positions[self.rows[rows]]
        return ShapeEvidence(np.take_along_axis(recorded, labels[..., None], axis=1), self.shape, options)

    @cached_property
    def everywhere(self) -> np.ndarray:
        """All of the frames, bool (rows,)."""
        return np.ones(len(self.rows), bool)

    @cached_property
    def likelihood(self) -> np.ndarray:
        """Log likelihoods (rows, labels, markers), see ShapeEvidence.label_log_likelihoods."""
        return self.fit(self.everywhere).label_log_likelihoods()

    @cached_property
    def likelihood_without_other(self) -> np.ndarray:
        """Log likelihoods (rows, labels, others) under own labels, see ShapeEvidence.own_log_likelihoods_without_other."""
        return self.fit(self.everywhere).own_log_likelihoods_without_other()

    @property
    def own_likelihood(self) -> np.ndarray:
        """Log likelihoods (rows, markers) of each marker under its own label."""
        own: np.ndarray = np.einsum("fmm->fm", self.likelihood)
        return own

    @cached_property
    def usual_likelihood(self) -> np.ndarray:
        """Usual log likelihood of each marker under its own label (markers,), NaN where it is unknown."""
        known = ~np.isnan(self.own_likelihood).all(axis=0)
        usual = np.full(len(known), np.nan)
        usual[known] = np.nanquantile(self.own_likelihood[:, known], self.options.usual_quantile, axis=0)
        return usual

    def misfit(self) -> np.ndarray:
        """Compute how badly the samples fit under their own labels.

        Returns
        -------
        np.ndarray
            Loss of log likelihood against what is usual of a marker in the recording (rows, markers); NaN where unknown.
        """
        misfit: np.ndarray = self.usual_likelihood - self.own_likelihood
        return misfit

    def pair_gains(self) -> np.ndarray:
        """Compute how much better the samples fit if two labels are exchanged.

        Returns
        -------
        np.ndarray
            Gains of log likelihood (rows, markers, markers), both samples together; 0 where neither is observed. The distance
            between the two does not count, since it stays the same. A sample that fits a marker worse than `max_misfit` may be no
            marker's: it says nothing of which label is right.
        """
        floor = np.nan_to_num(self.usual_likelihood - self.options.max_misfit, nan=-np.inf)
        gain = np.maximum(self.likelihood, floor)
        gain -= np.maximum(self.likelihood_without_other, floor[:, None])
        np.nan_to_num(gain, copy=False)
        both: np.ndarray = gain + gain.transpose(0, 2, 1)
        return both

    def group_gain(self, relabelling: Relabelling, rows: np.ndarray) -> np.ndarray:
        """Compute how much better the samples fit if the labels of a group are others.

        Parameters
        ----------
        relabelling : Relabelling
            The other labels.
        rows : np.ndarray
            Which of the frames, bool (rows,).

        Returns
        -------
        np.ndarray
            Gains of log likelihood (n,), of the markers of the group and of those that are judged by them.
        """
        before = self.fit(rows, group=True)
        after = self.fit(rows, relabelling.of(self.tracks.under[self.rows[rows]]), group=True)
        members = relabelling.markers
        judged = [
            m for m in range(len(self.shape.distance)) if m in members or np.isin(before.anchors(m), members).any()
        ]
        gain = after.own_log_likelihoods(np.array(judged)) - before.own_log_likelihoods(np.array(judged))
        total: np.ndarray = np.nan_to_num(gain).sum(axis=1)
        return total

    def changed(self, change: LabelChange) -> tuple[LabelEvidence, np.ndarray]:
        """Carry out a change.

        Parameters
        ----------
        change : LabelChange
            The change.

        Returns
        -------
        evidence : LabelEvidence
            The evidence with the labels that it supposes.
        rows : np.ndarray
            In which of the frames they differ, bool (rows,).
        """
        span = slice(change.start, change.stop)
        inside = (self.rows >= change.start) & (self.rows < change.stop)
        under = self.tracks.under.copy()
        under[span] = change.relabelling.of(under[span])
        after = replace(self, tracks=replace(self.tracks, under=under))
        fit = after.fit(inside)
        for name, anew in (
            ("likelihood", fit.label_log_likelihoods),
            ("likelihood_without_other", fit.own_log_likelihoods_without_other),
        ):
            likelihood = getattr(self, name).copy()
            likelihood[inside] = anew()
            after.__dict__[name] = likelihood  # what did not change is not computed again
        return after, inside
