"""The evidence for other labels over time: how much better samples fit, and between which frames labels may have changed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from markermend.core.shape import Shape
from markermend.detection.labelling.permutations import Permutation
from markermend.detection.labelling.sections import better_states
from markermend.numerics.intervals import runs
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.shape_evidence import ShapeEvidence


@dataclass(frozen=True)
class Relabelling:
    """Other labels of some markers.

    Attributes
    ----------
    permutation : Permutation
        Under which label each marker is.
    as_recorded : bool
        Whether these are labels as recorded, else labels after the changes that were found so far.
    """

    permutation: Permutation
    as_recorded: bool = False

    @property
    def markers(self) -> list[int]:
        """Indices of the markers."""
        return list(self.permutation.markers)

    def of(self, under: np.ndarray) -> np.ndarray:
        """Relabel the markers.

        Parameters
        ----------
        under : np.ndarray
            Under which label each marker was supposed to be recorded, int (frames, markers).

        Returns
        -------
        np.ndarray
            The same with other labels; frames in which the markers are exchanged with others stay as they are.
        """
        members, labels = self.markers, list(self.permutation.labels)
        after = under.copy()
        after[:, members] = labels if self.as_recorded else under[:, labels]
        if self.as_recorded:
            closed = (np.sort(after[:, members], axis=1) == np.sort(under[:, members], axis=1)).all(axis=1)
            after[~closed] = under[~closed]
        return after


@dataclass(frozen=True)
class LabelChange:
    """Other labels over a stretch, under which the samples fit better.

    Attributes
    ----------
    relabelling : Relabelling
        The labels.
    start, stop : int
        The stretch, [start, stop).
    evidence : float
        Gain of log likelihood, counting frames that are close in time as one.
    """

    relabelling: Relabelling
    start: int
    stop: int
    evidence: float

    @property
    def place(self) -> tuple[Relabelling, int, int]:
        """The labels and the stretch."""
        return self.relabelling, self.start, self.stop


@dataclass(frozen=True)
class LabelEvidence:
    """The samples of some frames under the labels that are supposed to be right, and how well they fit.

    Attributes
    ----------
    rows : np.ndarray
        The frames that are looked at (rows,), ascending.
    spacing_s : float
        Time between most of them, s.
    positions : np.ndarray
        Positions as recorded (frames, markers, 3), mm, NaN = missing.
    under : np.ndarray
        Under which label each marker is supposed to be recorded, int (frames, markers).
    present : np.ndarray
        Whether each label is recorded, bool (frames, markers).
    border : np.ndarray
        Where the trajectory of each label is broken, bool (frames, markers): see find_borders.
    shape : Shape
        The usual distances.
    options : LabelsOptions
        How clear the evidence must be.
    """

    rows: np.ndarray
    spacing_s: float
    positions: np.ndarray
    under: np.ndarray
    present: np.ndarray
    border: np.ndarray
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
        labels = self.under[self.rows[rows]] if under is None else under
        shape = self.options.shape
        options = replace(shape, anchors=self.options.group_anchors) if group else shape
        recorded = self.positions[self.rows[rows]]
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
            Gains of log likelihood (rows, markers, markers), both samples together; 0 where neither is observed. The distance between
            the two does not count, since it stays the same. A sample that fits a marker worse than `max_misfit` may be no marker's:
            it says nothing of which label is right.
        """
        floor = np.nan_to_num(self.usual_likelihood - self.options.max_misfit, nan=-np.inf)
        own = np.maximum(self.likelihood_without_other, floor[:, None])
        gain = np.nan_to_num(np.maximum(self.likelihood, floor) - own)
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
        after = self.fit(rows, relabelling.of(self.under[self.rows[rows]]), group=True)
        members = relabelling.markers
        judged = [
            m for m in range(len(self.shape.distance)) if m in members or np.isin(before.anchors(m), members).any()
        ]
        gain = after.own_log_likelihoods(np.array(judged)) - before.own_log_likelihoods(np.array(judged))
        total: np.ndarray = np.nan_to_num(gain).sum(axis=1)
        return total

    def best_change(self, relabelling: Relabelling, gain: np.ndarray) -> LabelChange | None:
        """Find the stretch between borders over which other labels are most clearly better.

        Parameters
        ----------
        relabelling : Relabelling
            The labels.
        gain : np.ndarray
            Gain of log likelihood with them (rows,).

        Returns
        -------
        LabelChange | None
            The change; None where none is clear enough, or where the samples do not fit with these labels either.
        """
        options, starts = self.options, self.section_starts(relabelling.markers)
        section = np.searchsorted(starts, self.rows, side="right") - 1
        value = np.bincount(section, weights=gain, minlength=len(starts))
        observed = self.present[self.rows][:, relabelling.markers].any(axis=1)
        count = np.bincount(section, weights=observed, minlength=len(starts))
        independent = min(1.0, self.spacing_s / options.correlation_s)
        changes = []
        for first, after in runs(better_states(value * independent, options.change_penalty)):
            seen = np.flatnonzero(count[first:after]) + first
            if len(seen):
                mean, number = float(value[seen].sum() / count[seen].sum()), float(count[seen].sum())
                evidence = mean * (1 + (number - 1) * independent)
                if mean >= options.min_mean_gain and evidence >= options.min_gain:
                    stop = int(starts[seen[-1] + 1]) if seen[-1] + 1 < len(starts) else len(self.under)
                    changes.append(LabelChange(relabelling, int(starts[seen[0]]), stop, evidence))
        changes.sort(key=lambda change: -change.evidence)
        return next((change for change in changes if self.misfit_after(change) <= options.max_misfit), None)

    def misfit_after(self, change: LabelChange) -> float:
        """Compute how badly the samples fit that get another label.

        Parameters
        ----------
        change : LabelChange
            The change.

        Returns
        -------
        float
            Mean loss of log likelihood of a marker against what is usual of it in the recording; the median over the markers,
            of two the smaller one, since the next change may be about the other, unless that did fit before.
        """
        rows = (self.rows >= change.start) & (self.rows < change.stop)
        under = change.relabelling.of(self.under[self.rows[rows]])
        members = np.array(change.relabelling.markers)
        misfit = self.usual_likelihood[members] - self.fit(rows, under).own_log_likelihoods(members)
        same = (under == self.under[self.rows[rows]])[:, members]
        misfit[same] = np.nan
        moved = ~np.isnan(misfit).all(axis=0)
        means = np.nanmean(misfit[:, moved], axis=0)
        if not len(means):
            return np.inf
        if len(means) == 2:
            before = np.where(same, np.nan, self.misfit()[rows][:, members])[:, moved]
            fitted = np.nan_to_num(np.nanmean(before, axis=0), nan=np.inf) <= self.options.max_misfit
            return float(max(means.min(), *means[fitted])) if fitted.any() else float(means.min())
        return float(np.sort(means)[(len(means) - 1) // 2])

    def section_starts(self, members: Sequence[int]) -> np.ndarray:
        """List the frames at which labels of some markers may pass to each other.

        Parameters
        ----------
        members : Sequence[int]
            Indices of the markers.

        Returns
        -------
        np.ndarray
            The first frames of the sections between them, 0 among them: where the trajectories of the markers that are
            observed before and after are broken, of the share `min_broken_share` of them at least. Where another label continues
            a trajectory, it is not broken.
        """
        labels = self.under[:, members]
        border = np.take_along_axis(self.border, labels, axis=1)
        frames, columns = np.nonzero(labels[1:] != labels[:-1])
        border[frames + 1, columns] = ~self._continues(frames + 1, labels[frames, columns], labels[frames + 1, columns])
        joined = np.take_along_axis(self.present, labels, axis=1)
        joined[1:] &= joined[:-1].copy()
        joined[0] = False
        broken = np.count_nonzero(border & joined, axis=1) >= self.options.min_broken_share * joined.sum(axis=1)
        return np.unique(np.concatenate([[0], np.flatnonzero(broken & border.any(axis=1))]))

    def _continues(self, frames: np.ndarray, before: np.ndarray, now: np.ndarray) -> np.ndarray:
        """Whether what is under one label from a frame on continues what was under another one before, bool (n,)."""
        step = np.linalg.norm(self.positions[frames, now] - self.positions[frames - 1, before], axis=1)
        jump = np.linalg.norm(self.positions[frames, now] - self.positions[frames - 1, now], axis=1)
        continues: np.ndarray = step <= self.options.max_remaining_fraction * jump
        return continues

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
        under = self.under.copy()
        under[span] = change.relabelling.of(under[span])
        after = replace(self, under=under)
        fit = after.fit(inside)
        for name, anew in (
            ("likelihood", fit.label_log_likelihoods),
            ("likelihood_without_other", fit.own_log_likelihoods_without_other),
        ):
            likelihood = getattr(self, name).copy()
            likelihood[inside] = anew()
            after.__dict__[name] = likelihood  # what did not change is not computed again
        return after, inside
