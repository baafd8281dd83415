"""Over which stretch other labels are better, and how well the samples fit then."""

from __future__ import annotations

import numpy as np

from markermend.detection.labelling.evidence import LabelEvidence
from markermend.detection.labelling.relabelling import LabelChange, Relabelling
from markermend.detection.labelling.sections import better_states
from markermend.numerics.intervals import runs


def best_change(evidence: LabelEvidence, relabelling: Relabelling, gain: np.ndarray) -> LabelChange | None:
    """Find the stretch between borders over which other labels are most clearly better.

    Parameters
    ----------
    evidence : LabelEvidence
        The samples under the labels that are supposed to be right so far.
    relabelling : Relabelling
        The labels.
    gain : np.ndarray
        Gain of log likelihood with them (rows,).

    Returns
    -------
    LabelChange | None
        The change; None where none is clear enough, or where the samples do not fit with these labels either.
    """
    options, starts = evidence.options, evidence.tracks.section_starts(relabelling.markers)
    section = np.searchsorted(starts, evidence.rows, side="right") - 1
    value = np.bincount(section, weights=gain, minlength=len(starts))
    observed = evidence.tracks.present[evidence.rows][:, relabelling.markers].any(axis=1)
    count = np.bincount(section, weights=observed, minlength=len(starts))
    independent = min(1.0, evidence.spacing_s / options.correlation_s)
    changes = []
    for first, after in runs(better_states(value * independent, options.change_penalty)):
        seen = np.flatnonzero(count[first:after]) + first
        if len(seen):
            mean, number = float(value[seen].sum() / count[seen].sum()), float(count[seen].sum())
            total = mean * (1 + (number - 1) * independent)
            long = number > options.max_exchanged_share * count.sum()
            floor = options.min_long_mean_gain if long else options.min_mean_gain
            if mean >= floor and total >= options.min_gain:
                stop = int(starts[seen[-1] + 1]) if seen[-1] + 1 < len(starts) else len(evidence.tracks.under)
                changes.append(LabelChange(relabelling, int(starts[seen[0]]), stop, total))
    changes.sort(key=lambda change: -change.evidence)
    return next((change for change in changes if misfit_after(evidence, change) <= options.max_misfit), None)


def misfit_after(evidence: LabelEvidence, change: LabelChange) -> float:
    """Compute how badly the samples fit that get another label.

    Parameters
    ----------
    evidence : LabelEvidence
        The samples under the labels that are supposed to be right so far.
    change : LabelChange
        The change.

    Returns
    -------
    float
        Mean loss of log likelihood of a marker against what is usual of it in the recording, median of the markers. Of two it is
        the smaller one, since the next change may be about the other, but never below that of a marker that fitted before.
    """
    rows = (evidence.rows >= change.start) & (evidence.rows < change.stop)
    under = change.relabelling.of(evidence.tracks.under[evidence.rows[rows]])
    members = np.array(change.relabelling.markers)
    misfit = evidence.usual_likelihood[members] - evidence.fit(rows, under).own_log_likelihoods(members)
    same = (under == evidence.tracks.under[evidence.rows[rows]])[:, members]
    misfit[same] = np.nan
    moved = ~np.isnan(misfit).all(axis=0)
    means = np.nanmean(misfit[:, moved], axis=0)
    if not len(means):
        return np.inf
    if len(means) == 2:
        before = np.where(same, np.nan, evidence.misfit()[rows][:, members])[:, moved]
        fitted = np.nan_to_num(np.nanmean(before, axis=0), nan=np.inf) <= evidence.options.max_misfit
        return float(max(means.min(), *means[fitted])) if fitted.any() else float(means.min())
    return float(np.sort(means)[(len(means) - 1) // 2])
