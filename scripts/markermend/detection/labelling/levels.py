"""Exchanges of labels by level: samples that fit the subject's usual shape better under other labels.

No change from one frame to the next is needed, so that exchanges across gaps are found. The labels that explain most of the
misfit are taken first, over the stretch between gaps, jumps or ends of the recording where they do, and the rest is judged anew:
pairs, of which cycles are made up, and whole groups of markers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from markermend.detection.labelling.cuts import likeliest_exchange
from markermend.detection.labelling.evidence import LabelEvidence
from markermend.detection.labelling.groups import counterparts_by_side, counterparts_by_subject, group_exchanges
from markermend.detection.labelling.label_changes import best_change
from markermend.detection.labelling.permutations import Permutation
from markermend.detection.labelling.relabelling import LabelChange, Relabelling


def relabel_by_level(
    evidence: LabelEvidence, score: np.ndarray, *, markers: Sequence[str]
) -> tuple[LabelEvidence, np.ndarray]:
    """Find the labels under which the samples fit the subject's usual shape.

    Parameters
    ----------
    evidence : LabelEvidence
        The samples under the labels that are supposed to be right so far.
    score : np.ndarray
        Evidence for these in units of the threshold (frames, markers).
    markers : Sequence[str]
        Names of the markers.

    Returns
    -------
    evidence : LabelEvidence
        The samples under the right labels.
    score : np.ndarray
        Evidence for them (frames, markers).
    """
    score = score.copy()
    gains = {
        relabelling: evidence.group_gain(relabelling, evidence.everywhere)
        for relabelling in group_relabellings(evidence, markers)
    }
    made: set[tuple[Relabelling, int, int]] = set()
    for _ in range(evidence.options.max_changes):
        # Groups are judged by other anchors than pairs: what was made once is not taken back.
        possible = (change for change in possible_changes(evidence, gains) if change.place not in made)
        best = max(possible, key=lambda change: change.evidence, default=None)
        if best is None:
            break
        made.add(best.place)
        before = evidence.tracks.under
        evidence, rows = evidence.changed(best)
        moved = evidence.tracks.under != before
        score[moved] = np.maximum(score[moved], best.evidence / evidence.options.min_gain)
        for relabelling, gain in gains.items():
            gain[rows] = evidence.group_gain(relabelling, rows)
    return evidence, score


def possible_changes(evidence: LabelEvidence, gains: Mapping[Relabelling, np.ndarray]) -> Iterator[LabelChange]:
    """List the changes of labels that make the samples fit better.

    Parameters
    ----------
    evidence : LabelEvidence
        The samples under the labels that are supposed to be right so far.
    gains : Mapping[Relabelling, np.ndarray]
        Gain of log likelihood (rows,) by other labels of groups.

    Yields
    ------
    LabelChange
        For each pair and each group the clearest one, if any.
    """
    floor, of_pairs = evidence.options.min_mean_gain, evidence.pair_gains()
    better = np.triu(of_pairs.max(axis=0, initial=0.0) >= floor, 1)
    pairs = [Relabelling(Permutation((a, b), (b, a))) for a, b in np.argwhere(better).tolist()]
    found = [best_change(evidence, own, of_pairs[:, own.markers[0], own.markers[1]]) for own in pairs]
    found += [best_change(evidence, own, gain) for own, gain in gains.items() if gain.max(initial=0.0) >= floor]
    yield from (change for change in found if change is not None)


def group_relabellings(evidence: LabelEvidence, markers: Sequence[str]) -> list[Relabelling]:
    """List the other labels of whole groups that are looked for.

    Parameters
    ----------
    evidence : LabelEvidence
        The samples under the labels that are supposed to be right so far.
    markers : Sequence[str]
        Names of the markers.

    Returns
    -------
    list[Relabelling]
        Exchanges of parts of the body with their counterparts, and of what is likeliest between frames at which trajectories of
        several markers are broken.
    """
    permutations = group_exchanges(markers, evidence.shape)
    for counterpart in (counterparts_by_side(markers), counterparts_by_subject(markers)):
        if counterpart:
            permutations += likeliest_groups(evidence, counterpart)
    found = dict.fromkeys(Relabelling(own) for own in permutations)
    usual = np.arange(evidence.tracks.under.shape[1])
    for own in permutations:
        members = list(own.markers)
        if (evidence.tracks.under[:, members] != usual[members]).any():
            whole = (own, Permutation.identity(own.markers))
            found.update(dict.fromkeys(Relabelling(permutation, as_recorded=True) for permutation in whole))
    return list(found)


def likeliest_groups(evidence: LabelEvidence, counterpart: Mapping[int, int]) -> list[Permutation]:
    """Find the groups that are likeliest to be exchanged between frames at which several trajectories are broken.

    Parameters
    ----------
    evidence : LabelEvidence
        The samples.
    counterpart : Mapping[int, int]
        Index of the counterpart of each marker that has one.

    Returns
    -------
    list[Permutation]
        Exchanges of two pairs at least, each once, of the longest sections: all that are likeliest to be exchanged in a section,
        those of them that may have been exchanged at its start, and at its end, and all whose trajectories are broken there. Limbs
        may be exchanged at the same time, and a marker that is seen all along hangs together with a limb that is not.
    """
    options = evidence.options
    broken = evidence.tracks.border[:, sorted(counterpart)].sum(axis=1) >= 2 * options.min_group_pairs
    cuts = [0, *(np.flatnonzero(broken[1:]) + 1).tolist(), len(evidence.tracks.under)]
    sections = sorted(pairwise(cuts), key=lambda section: section[0] - section[1])[: options.max_group_sections]
    every = Permutation(tuple(sorted(counterpart)), tuple(counterpart[m] for m in sorted(counterpart)))
    found: dict[Permutation, None] = {}
    for start, stop in sections:
        rows = (evidence.rows >= start) & (evidence.rows < stop)
        recorded = np.tile(np.arange(evidence.tracks.under.shape[1]), (int(np.count_nonzero(rows)), 1))
        exchange = likeliest_exchange(evidence.fit(rows, recorded, group=True), counterpart) if rows.any() else None
        ends = [evidence.tracks.border[cut] for cut in (start, stop) if 0 < cut < len(evidence.tracks.under)]
        possible = [_passing(every, broken, both=True) for broken in ends]
        if exchange:
            possible += [exchange, *(_passing(exchange, broken) for broken in ends)]
        found.update((own, None) for own in possible if len(own.markers) >= 2 * options.min_group_pairs)
    return list(found)


def _passing(exchange: Permutation, broken: np.ndarray, *, both: bool = False) -> Permutation:
    """The pairs of an exchange of which a trajectory, or both, is broken, bool (markers,): no others pass to each other there."""
    pairs = zip(exchange.markers, exchange.labels, strict=True)
    enough = np.all if both else np.any
    passing = [(m, label) for m, label in pairs if enough(broken[[m, label]])]
    return Permutation(tuple(m for m, _ in passing), tuple(label for _, label in passing))
