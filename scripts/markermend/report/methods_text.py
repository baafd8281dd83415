"""The methods paragraph of a paper, written from the steps that really ran, with its references."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from markermend.core.artifacts import ARTIFACTS

REFERENCES = {
    "artifacts": "Skurowski P, Pawlyta M. Detection and classification of artifact distortions in optical motion "
    "capture sequences. Sensors 2022; 22(11): 4076. https://doi.org/10.3390/s22114076",
    "mesh": "Skurowski P, Pawlyta M. Gap reconstruction in optical motion capture sequences using neural networks. "
    "Sensors 2021; 21(18): 6115. https://doi.org/10.3390/s21186115",
    "averaging": "Tits M, Tilmanne J, Dutoit T. Robust and automatic motion-capture data recovery using soft skeleton "
    "constraints and model averaging. PLoS ONE 2018; 13(7): e0199744. https://doi.org/10.1371/journal.pone.0199744",
}
"""What is cited, by the key that a sentence uses."""

PRESETS = {
    "default": "in the residual of each marker against a prediction from its neighbours on the body",
    "coordinates": "in each coordinate by itself",
    "paper": "in each coordinate by itself, as published",
}
"""Where the detectors look, by their option `preset`."""

WEIGHTS = {
    "error": "weighted by their errors on gaps of the same length made elsewhere on the same marker",
    "pma": "weighted by the likelihood of the distances between markers that they lead to",
    "both": "weighted by their errors on gaps of the same length made elsewhere on the same marker, and by the likelihood "
    "of the distances between markers that they lead to",
    "equal": "all weighted alike",
}
"""How the predictors are weighted, by the fill stage's option `weights`."""

LIMITS = {
    "max_gap_s": "of at most {:g} s",
    "max_repair_s": "in stretches of at most {:g} s",
    "max_error_mm": "with an expected error of at most {:g} mm",
}
"""Options that say how far a stage may go."""


def paragraph(stages: Mapping[str, Mapping[str, Any]], kind: str | None, version: str) -> dict[str, Any]:
    """Write what was done to a recording.

    stages: the options of each stage that ran, by its name. kind: "static" recordings are only checked. Returns `text`
    and `references`, the keys of REFERENCES in the order of citation; equal steps give equal text.
    """
    cited: list[str] = []

    def cite(key: str) -> str:
        cited.append(key)
        return f"[{len(cited)}]"

    told = [
        f"Marker trajectories were processed with markermend {version}. Samples that the capture program marked as "
        "invalid were taken as missing; unlabelled trajectories, model outputs and analog data were left alone."
    ]
    if kind == "static":
        told.append("Static recordings were checked only: nothing in them was repaired or filled.")
        return {"text": " ".join(told), "references": cited}
    if "mesh" in stages:
        told.append(
            "A functional body mesh, rigid segments of markers in a tree, was inferred from each subject's recordings "
            f"{cite('mesh')}."
        )
    if sought := [artifact for artifact in ARTIFACTS if artifact.stage in stages and not artifact.unmeasured]:
        classes = ", ".join(artifact.plural for artifact in sought)
        places = dict.fromkeys(PRESETS.get(stages[artifact.stage].get("preset", ""), "") for artifact in sought)
        where = " or ".join(place for place in places if place)
        told.append(f"Artifacts were sought in the order {classes} {cite('artifacts')}{', ' if where else ''}{where}.")
        if "repair" in stages:
            told.append(
                f"They were repaired by class{limits(stages['repair'])}; samples for which no repair could be trusted "
                "were set to missing."
            )
    unmeasured = [f"{a.plural} ({a.unmeasured})" for a in ARTIFACTS if a.unmeasured and a.stage in stages]
    if unmeasured:
        told.append(f"Taken as missing, too, were {' and '.join(unmeasured)}.")
    if "fill" in stages:
        told.append(_filling(stages["fill"], cite("averaging")))
    if stages.get("fill", {}).get("decisions"):
        told.append("Where a person reviewed findings and gaps, the decision of that person stood over these rules.")
    told.append(
        "Changed samples, and only those, were overwritten in a copy of each file, which was then compared with the "
        "original byte by byte."
    )
    return {"text": " ".join(told), "references": cited}


def _filling(options: Mapping[str, Any], citation: str) -> str:
    """Tell how gaps were filled."""
    members = [name.replace("_", " ") for name in options.get("members", ())]
    named = f" ({', '.join(members)})" if members else ""
    weights = WEIGHTS.get(options.get("weights", ""), "")
    return (
        f"Gaps{limits(options)} were filled by averaging predictors{named}{', ' if weights else ''}{weights} {citation}; "
        "the expected error of each filled sample was calibrated on such gaps."
    )


def limits(options: Mapping[str, Any]) -> str:
    """Name the limits among a stage's options, with a leading space; nothing where there are none."""
    told = [phrase.format(options[key]) for key, phrase in LIMITS.items() if isinstance(options.get(key), int | float)]
    return f" {' and '.join(told)}" if told else ""
