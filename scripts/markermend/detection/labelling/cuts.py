"""Which markers are exchanged with their counterparts over a stretch: the likeliest set of them, by a minimum cut.

Each pair of counterparts is exchanged or not. The misfit of a distance depends on the states of both of its ends; two that are
exchanged alike fit each other in any case. The set with the least misfit is a minimum cut of a graph (Greig, Porteous & Seheult
1989), so that a limb is found as a whole, whichever markers belong to it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from markermend.detection.labelling.permutations import Permutation
from markermend.prediction.shape_evidence import ShapeEvidence

RESOLUTION = 1000.0
"""Flows are whole numbers: steps of log likelihood per unit."""


def likeliest_exchange(evidence: ShapeEvidence, counterpart: Mapping[int, int]) -> Permutation | None:
    """Find the set of markers that are likeliest to be exchanged with their counterparts.

    Parameters
    ----------
    evidence : ShapeEvidence
        Positions of a stretch under the labels as recorded, and the usual distances.
    counterpart : Mapping[int, int]
        Index of the counterpart of each marker that has one.

    Returns
    -------
    Permutation | None
        The exchange; None where none is likelier than the labels as recorded.
    """
    pairs = sorted((m, other) for m, other in counterpart.items() if m < other)
    single, joint = misfits(evidence, pairs)
    exchanged = minimum_cut(single, joint)
    own = [m for pair, state in zip(pairs, exchanged.tolist(), strict=True) if state for m in pair]
    members = tuple(sorted(own))
    return Permutation(members, tuple(counterpart[m] for m in members)) if members else None


def misfits(evidence: ShapeEvidence, pairs: Sequence[tuple[int, int]]) -> tuple[np.ndarray, np.ndarray]:
    """Compute the misfit of the distances for all states of the pairs.

    Parameters
    ----------
    evidence : ShapeEvidence
        Positions of a stretch under the labels as recorded, and the usual distances.
    pairs : Sequence[tuple[int, int]]
        Pairs of counterparts.

    Returns
    -------
    single : np.ndarray
        Misfit of each pair with the markers that have no counterpart, by its state (pairs, 2).
    joint : np.ndarray
        Misfit of each two pairs with each other, by the states of both (pairs, pairs, 2, 2).
    """
    pair_of = {m: k for k, pair in enumerate(pairs) for m in pair}
    other = {m: pair[::-1][pair.index(m)] for pair in pairs for m in pair}
    single, joint = np.zeros((len(pairs), 2)), np.zeros((len(pairs), len(pairs), 2, 2))
    for marker in range(evidence.positions.shape[1]):
        anchors = evidence.anchors(marker)
        mirrored = np.array([other.get(a, a) for a in anchors.tolist()], int)
        own = pair_of.get(marker)
        for state, label in enumerate((marker, other.get(marker, marker))):
            for anchor_state, labels in enumerate((anchors, mirrored)):
                misfit = evidence.mean_misfits(marker, label, anchors, labels).tolist()
                for anchor, value in zip(anchors.tolist(), misfit, strict=True):
                    k = pair_of.get(anchor)
                    if own is not None and k is not None and own != k:
                        joint[own, k, state, anchor_state] += value
                    elif own is not None and k is None and not anchor_state:
                        single[own, state] += value
                    elif own is None and k is not None and not state:
                        single[k, anchor_state] += value
    return single, joint


def minimum_cut(single: np.ndarray, joint: np.ndarray) -> np.ndarray:
    """Find the states with the least total.

    Parameters
    ----------
    single : np.ndarray
        Cost of each node by its state (nodes, 2).
    joint : np.ndarray
        Cost of each two nodes by the states of both (nodes, nodes, 2, 2); where equal states cost more than unlike ones, the
        difference is left out.

    Returns
    -------
    np.ndarray
        Whether each node has the second state, bool (nodes,); the first one among equals.
    """
    from scipy.sparse import coo_array  # 0.1 s to import, and few recordings get here
    from scipy.sparse.csgraph import breadth_first_order, maximum_flow

    count = len(single)
    cost = single[:, 1] - single[:, 0]
    cost = (
        cost + (joint[:, :, 1, 0] - joint[:, :, 0, 0]).sum(axis=1) + (joint[:, :, 1, 1] - joint[:, :, 1, 0]).sum(axis=0)
    )
    between = np.maximum(joint[:, :, 0, 1] + joint[:, :, 1, 0] - joint[:, :, 0, 0] - joint[:, :, 1, 1], 0)
    capacity = np.zeros((count + 2, count + 2))
    capacity[:count, :count] = between
    capacity[count, :count], capacity[:count, count + 1] = np.maximum(cost, 0), np.maximum(-cost, 0)
    whole = coo_array(np.round(capacity * RESOLUTION).astype(np.int32)).tocsr()
    flow = maximum_flow(whole, count, count + 1).flow
    residual = coo_array(whole - flow).tocsr()
    residual.data = np.where(residual.data > 0, 1, 0)
    residual.eliminate_zeros()
    exchanged = np.zeros(count + 2, bool)
    # From these nodes the sink can still be reached; those from which neither end can be are as good in either state.
    exchanged[breadth_first_order(residual.T.tocsr(), count + 1, return_predecessors=False)] = True
    return exchanged[:count]
