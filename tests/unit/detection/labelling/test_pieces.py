"""Pieces are assigned to markers as the best of all assignments says, and by how much it leads."""

from itertools import product

import numpy as np
import pytest

from markermend.detection.labelling.pieces import WORST, Piece, assigned


def test_pieces_meet_in_a_common_frame():
    assert Piece("*1", 0, 10).meets(Piece("*2", 9, 12)) and not Piece("*1", 0, 10).meets(Piece("*2", 10, 12))


def best_total(costs, without=None):
    """The least total cost of all assignments one to one, none of a piece to a marker that is excluded, and the assignment."""
    options = [[None, *(m for m in own if (piece, m) != without)] for piece, own in costs.items()]
    totals = {
        chosen: sum(WORST if m is None else own[m] for m, own in zip(chosen, costs.values(), strict=True))
        for chosen in product(*options)
        if len({m for m in chosen if m is not None}) == sum(m is not None for m in chosen)
    }
    best = min(totals, key=totals.get)
    return totals[best], dict(zip(costs, best, strict=True))


@pytest.mark.parametrize("seed", range(20))
def test_pieces_of_one_time_are_assigned_as_by_brute_force(seed):
    rng = np.random.default_rng(seed)
    costs = {
        Piece(f"*{k}", 0, 10): {
            m: float(rng.uniform(0, 2)) if rng.random() < 0.8 else np.inf for m in range(4) if rng.random() < 0.8
        }
        for k in range(3)
    }
    total, chosen = best_total(costs)
    expected = {}
    for piece, m in chosen.items():
        if m is not None:
            lead = best_total(costs, without=(piece, m))[0] - total
            if lead >= 0.3:
                expected[piece] = (m, pytest.approx(lead))
    assert {piece: (m, lead) for piece, m, lead in assigned(costs, min_lead=0.3)} == expected
