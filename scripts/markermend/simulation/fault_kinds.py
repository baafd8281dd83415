"""The kinds of faults that recordings have, each with generators to choose thresholds on and others to report on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from markermend.simulation import displacement_shapes, drift_shapes, oscillation_shapes
from markermend.simulation.displaced_markers import (
    creeping,
    displaced,
    filled_by_program,
    knocked,
    sentinel,
    still_ghost,
)
from markermend.simulation.exchanged_labels import across_gap, from_frame_to_frame, limbs
from markermend.simulation.faults import Generator
from markermend.simulation.foreign_labels import fallen, on_another_marker, on_one_spot, still_reflection
from markermend.simulation.system_faults import camera_hit, repeated_frames, segment_slip


@dataclass(frozen=True)
class FaultKind:
    """One kind of fault.

    Attributes
    ----------
    name : str
        The kind in a word or two.
    choosing, reporting : tuple of Generator
        Generators of its forms: to choose thresholds on, and to report on.
    classes : tuple of str
        Classes of findings that name it rightly, or stages of which all classes do.
    alone : bool
        Whether a copy with one holds no faults of other kinds: it concerns all markers, or many of them.
    """

    name: str
    choosing: tuple[Generator, ...]
    reporting: tuple[Generator, ...]
    classes: tuple[str, ...]
    alone: bool = False


def _drift(low_s: float, high_s: float, size_mm: float) -> FaultKind:
    """Drifts of a duration and size."""
    seconds = f"{low_s:g}" if low_s == high_s else f"{low_s:g}-{high_s:g}"
    forms = ("raised cosine", drift_shapes.raised_cosine), ("skewed", drift_shapes.skewed_bump)
    one, other = ((displaced(name, shape(low_s, high_s, size_mm)),) for name, shape in forms)
    return FaultKind(f"drift {seconds} s {size_mm:g} mm", one, other, ("slow",))


FAULT_KINDS = (
    FaultKind(
        "exchange",
        (from_frame_to_frame(markers=2),),
        (from_frame_to_frame(markers=3), from_frame_to_frame(markers=2)),
        ("swap",),
    ),
    FaultKind(
        "exchange across gap",
        (
            across_gap(markers=2, staggered=False, until="next gap"),
            across_gap(markers=3, staggered=False, until="next gap"),
            across_gap(markers=2, staggered=True, until="end"),
        ),
        (
            across_gap(markers=2, staggered=True, until="next gap"),
            across_gap(markers=2, staggered=True, until="later gap"),
            across_gap(markers=3, staggered=True, until="later gap"),
            across_gap(markers=2, staggered=False, until="end"),
        ),
        ("swap",),
    ),
    FaultKind("limbs exchanged", (limbs(across_gaps=False),), (limbs(across_gaps=True),), ("swap",), alone=True),
    FaultKind(
        "on reflection",
        (still_reflection(unsteady=False),),
        (still_reflection(unsteady=True),),
        ("foreign",),
    ),
    FaultKind(
        "on other marker",
        (on_another_marker(gaps=False), on_another_marker(gaps=True)),
        (on_another_marker(gaps=True), on_another_marker(gaps=False)),
        ("foreign", "swap"),
    ),
    FaultKind("fallen", (fallen(unseen=False),), (fallen(unseen=True),), ("foreign",)),
    FaultKind("on one spot", (on_one_spot(noise_mm=0.0),), (on_one_spot(noise_mm=0.3),), ("foreign", "swap")),
    *(
        FaultKind(
            f"knocked{', rigid' if rigid else ''}",
            (knocked(rigid=rigid, settling=False),),
            (knocked(rigid=rigid, settling=True),),
            ("displaced", "creep"),
        )
        for rigid in (True, False)
    ),
    *(
        FaultKind(
            f"creeping{', rigid' if rigid else ''}",
            (creeping(rigid=rigid, stepwise=False),),
            (creeping(rigid=rigid, stepwise=True),),
            ("displaced", "creep"),
        )
        for rigid in (True, False)
    ),
    FaultKind(
        "frames repeated",
        (repeated_frames(alternate=False),),
        (repeated_frames(alternate=True),),
        ("frames",),
        alone=True,
    ),
    FaultKind("camera hit", (camera_hit(turned=False),), (camera_hit(turned=True),), ("frames",), alone=True),
    FaultKind("segment slip", (segment_slip(rounded=False),), (segment_slip(rounded=True),), ("frames",), alone=True),
    FaultKind(
        "wobble",
        (displaced("sine", oscillation_shapes.swelling_sine),),
        (displaced("noise of 5-12 Hz", oscillation_shapes.band_limited_noise),),
        ("noise",),
    ),
    FaultKind(
        "jitter",
        (displaced("white noise", oscillation_shapes.white_noise),),
        (displaced("to and fro", oscillation_shapes.alternating_jumps),),
        ("noise",),
    ),
    FaultKind(
        "flicker",
        (displaced("random", displacement_shapes.random_telegraph),),
        (displaced("blocks", displacement_shapes.alternating_blocks),),
        ("step", "noise"),
    ),
    FaultKind(
        "dip",
        (displaced("straight ramps", displacement_shapes.plateau_with_ramps),),
        (displaced("rounded ramps", displacement_shapes.sagging_dip),),
        ("step", "peak"),
    ),
    FaultKind(
        "line of sight",
        (displaced("constant", displacement_shapes.constant_offset),),
        (displaced("uneven", displacement_shapes.uneven_offset),),
        ("step",),
    ),
    FaultKind(
        "ghost",
        (displaced("following", displacement_shapes.constant_jump),),
        (still_ghost(30.0, 150.0),),
        ("peak", "step"),
    ),
    FaultKind(
        "ghost, metres",
        (displaced("following", displacement_shapes.distant_jump),),
        (still_ghost(1000.0, 5000.0),),
        ("peak", "step"),
    ),
    FaultKind("sentinel", (sentinel(axes=3),), (sentinel(axes=1),), ("peak", "step")),
    FaultKind("program's filling", (filled_by_program(cubic=False),), (filled_by_program(cubic=True),), ("slow",)),
    _drift(0.3, 0.8, 5),
    _drift(0.3, 0.8, 10),
    _drift(1.4, 1.4, 5),
    _drift(1.4, 1.4, 10),
    _drift(2, 5, 5),
    _drift(2, 5, 10),
)
"""The kinds that recordings have besides the artifacts of the published contamination."""

PEAK = FaultKind(
    "peak",
    (displaced("half a sine", displacement_shapes.half_sine),),
    (displaced("uneven", displacement_shapes.uneven_peak),),
    ("peak",),
)
"""An isolated peak as in the published contamination."""

KINDS: Mapping[str, FaultKind] = {kind.name: kind for kind in (*FAULT_KINDS, PEAK)}
"""All kinds by their names."""


def generators(kind: str, *, use: str) -> tuple[Generator, ...]:
    """Give the generators of a kind.

    Parameters
    ----------
    kind : str
        Its name.
    use : str
        "choosing" or "reporting".

    Returns
    -------
    tuple of Generator
        The generators, to be used in turn.

    Raises
    ------
    ValueError
        For another use.
    """
    if use == "choosing":
        return KINDS[kind].choosing
    if use == "reporting":
        return KINDS[kind].reporting
    raise ValueError(f"{use!r} is neither choosing nor reporting")
