"""Which labels may have been exchanged together: those of a limb with its counterpart on the other side or on another subject.

Distances within an exchanged limb are right, so that no single one of its markers shows the exchange: it must be looked for as a
whole. The limbs are the parts that fall off when one edge of the tree of the steadiest distances is cut.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from markermend.core.shape import Shape
from markermend.detection.labelling.permutations import Permutation
from markermend.numerics import graphs

OTHER_SIDE = {"left": "right", "right": "left", "l": "r", "r": "l"}
"""What the name of a marker has in the place of the side, in lower case, and what its counterpart has there."""

SIDES = re.compile("|".join(OTHER_SIDE))
"""The places in a name that may state the side."""


def counterparts_by_side(markers: Sequence[str]) -> dict[int, int]:
    """Pair the markers of the left with those of the right by their names.

    Parameters
    ----------
    markers : sequence of str
        Names of the markers.

    Returns
    -------
    dict of int to int
        Index of the counterpart of each marker that has one: its name differs in the side alone, whatever the case.
    """
    place = {name.casefold(): m for m, name in enumerate(markers)}
    found: dict[int, int] = {}
    for m, name in enumerate(name.casefold() for name in markers):
        others = (
            place.get(name[: side.start()] + OTHER_SIDE[side.group()] + name[side.end() :])
            for side in SIDES.finditer(name)
        )
        counterpart = next((other for other in others if other is not None), m)
        if counterpart != m:
            found[m] = counterpart
    return {m: other for m, other in found.items() if found.get(other) == m}


def counterparts_by_subject(markers: Sequence[str]) -> dict[int, int]:
    """Pair the markers of two subjects by their names.

    Parameters
    ----------
    markers : sequence of str
        Names of the markers.

    Returns
    -------
    dict of int to int
        Index of the counterpart of each marker that has one: the same name after another prefix, if there are two of them.
    """
    named: dict[str, list[int]] = {}
    for m, name in enumerate(markers):
        prefix, colon, own = name.rpartition(":")
        if colon and prefix:
            named.setdefault(own, []).append(m)
    pairs = [own for own in named.values() if len(own) == 2]
    return {m: other for pair in pairs for m, other in (pair, pair[::-1])}


def steadiest_parts(shape: Shape) -> list[frozenset[int]]:
    """List the parts of the subjects that hang together by the steadiest distances.

    Parameters
    ----------
    shape : Shape
        The usual distances.

    Returns
    -------
    list of frozenset of int
        The markers on either side of each edge of the minimum spanning tree of the deviations, smaller parts first.
    """
    count = len(shape.deviation)
    known = ~np.isnan(shape.deviation) & ~np.eye(count, dtype=bool)
    # Among equals near markers hang together.
    tree = graphs.spanning_tree(np.where(known, (shape.deviation + 1) * np.sqrt(shape.distance + 1), np.inf))
    parts: set[frozenset[int]] = set()
    for edge in tree:
        left = graphs.adjacency([other for other in tree if other != edge], count)
        parts |= {frozenset(graphs.breadth_first(left, end)[0]) for end in edge}
    return sorted(parts, key=lambda part: (len(part), sorted(part)))


def group_exchanges(markers: Sequence[str], shape: Shape) -> list[Permutation]:
    """List the exchanges of whole groups of labels that are looked for.

    Parameters
    ----------
    markers : sequence of str
        Names of the markers.
    shape : Shape
        The usual distances.

    Returns
    -------
    list of Permutation
        Each exchanges the markers of a part of a subject with their counterparts outside of it, of two markers at least.
    """
    found: dict[tuple[int, ...], Permutation] = {}
    for counterpart in (counterparts_by_side(markers), counterparts_by_subject(markers)):
        for part in steadiest_parts(shape):
            own = [m for m in sorted(part) if m in counterpart and counterpart[m] not in part]
            if len(own) >= 2:
                members = tuple(sorted({*own, *(counterpart[m] for m in own)}))
                labels = tuple(counterpart[m] for m in members)
                found.setdefault((*members, -1, *labels), Permutation(members, labels))
    return list(found.values())
