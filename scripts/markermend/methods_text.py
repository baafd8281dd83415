"""The methods paragraph of a paper, written from the steps that really ran, with its references."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

REFERENCES = {
    "artifacts": "Skurowski P, Pawlyta M. Detection and classification of artifact distortions in optical motion "
    "capture sequences. Sensors 2022; 22(11): 4076. https://doi.org/10.3390/s22114076",
    "mesh": "Skurowski P, Pawlyta M. Gap reconstruction in optical motion capture sequences using neural networks. "
    "Sensors 2021; 21(18): 6115. https://doi.org/10.3390/s21186115",
    "averaging": "Tits M, Tilmanne J, Dutoit T. Robust and automatic motion-capture data recovery using soft skeleton "
    "constraints and model averaging. PLoS ONE 2018; 13(7): e0199744. https://doi.org/10.1371/journal.pone.0199744",
}
"""What is cited, by the key that a sentence uses."""

DETECTORS = {"peaks": "isolated peaks", "noise": "heavy noise", "steps": "steps and label swaps", "slow": "slow drifts"}
"""What each detector looks for."""


def paragraph(stages: Mapping[str, Mapping[str, Any]], kind: str | None, version: str) -> dict[str, Any]:
    """Write what was done to a recording.

    stages: the options of each stage that ran, by its name. kind: "static" recordings are only checked. Returns `text`
    and `references`, the keys of REFERENCES in the order of citation; equal steps give equal text.
    """
    told = [
        f"Marker trajectories were processed with markermend {version}. Samples that the capture program marked as "
        "invalid were taken as missing; unlabelled trajectories, model outputs and analog data were left alone."
    ]
    cited: list[str] = []
    if kind == "static":
        told.append("Static recordings were checked only: nothing in them was repaired or filled.")
        return {"text": " ".join(told), "references": cited}
    if "mesh" in stages:
        cited.append("mesh")
        told.append(
            f"A functional body mesh, rigid segments of markers in a tree, was inferred from each subject's recordings "
            f"[{len(cited)}]."
        )
    if detectors := [DETECTORS[name] for name in DETECTORS if name in stages]:
        cited.append("artifacts")
        told.append(
            f"Artifacts were sought in the order {', '.join(detectors)} [{len(cited)}], in the residual of each marker "
            "against a prediction from its neighbours on the body."
        )
    if "repair" in stages and detectors:
        told.append(
            f"What was found was repaired by class{_limits(stages['repair'])}; what no repair could be trusted with was set to missing."
        )
    if "fill" in stages:
        cited.append("averaging")
        told.append(
            f"Gaps{_limits(stages['fill'])} were filled by averaging predictors, weighted by their errors on gaps of the "
            f"same length made elsewhere on the same marker [{len(cited)}]; these errors also give the expected error of "
            "each filled sample."
        )
    if "export" in stages:
        told.append(
            "Only the changed samples were overwritten in a copy of each file; the copy was compared with the original byte by byte."
        )
    return {"text": " ".join(told), "references": cited}


def _limits(options: Mapping[str, Any]) -> str:
    """Name the limits among a stage's options that say how far it may go."""
    phrases = {
        "max_gap_s": "of at most {:g} s",
        "max_repair_s": "in stretches of at most {:g} s",
        "max_error_mm": "with an expected error of at most {:g} mm",
    }
    told = [phrase.format(options[key]) for key, phrase in phrases.items() if isinstance(options.get(key), int | float)]
    return f" {' and '.join(told)}" if told else ""
