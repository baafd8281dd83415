"""The methods paragraph of a paper, written from the steps that really ran, with its references."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby
from typing import Any

from markermend.core.artifacts import ARTIFACTS, ArtifactClass
from markermend.report.methods_filling import filling_sentences
from markermend.report.phrases import enumeration, limits
from markermend.report.references import Citations

PLACES = {
    "labels": "by the continuity of trajectories and the distances between markers",
    "frames": "in the motion that markers share",
}
"""Where the detectors without presets look."""

PRESETS = {
    "default": "in the residual of each marker from a prediction by its neighbours on the body",
    "coordinates": "in each coordinate separately",
    "paper": "in each coordinate separately, as published",
}
"""Where the detectors look, by their option `preset`."""

REPAIRS = {
    "spline": "a cubic spline",
    "linear": "linear interpolation",
    "savitzky_golay": "a Savitzky-Golay filter",
    "polynomial": "polynomial regression on neighbouring markers",
    "replicated_network": "a feed-forward neural network",
}
"""The methods of repair that were published, by their names."""

Stages = Mapping[str, Mapping[str, Any]]
"""The options of each stage that ran, by its name, as the footers of its files state them."""


def paragraph(
    stages: Stages, kind: str | None, version: str, *, pooled: bool = False, filled: bool = True, repaired: bool = True
) -> dict[str, Any]:
    """Write what was done to a recording.

    Parameters
    ----------
    stages : mapping of str to mapping
        The options of each stage that ran, by its name.
    kind : str or None
        Kind of the recording; those of kind `static` are only checked.
    version : str
        Version of the program.
    pooled : bool
        Whether filling learned from the subject's other recordings, too.
    filled, repaired : bool
        Whether any gap was filled, and whether any artifact was repaired or taken away: else the text does not say how.

    Returns
    -------
    dict
        `text`, and `references`: the keys of REFERENCES in the order of citation. Equal steps give equal text.
    """
    citations = Citations()
    sentences = [
        f"Marker trajectories were processed with markermend {version} {citations.cite('software')}. Samples that the capture program had marked as "
        "invalid were treated as missing; unlabelled trajectories, model outputs and analog data were left unchanged."
    ]
    if kind == "static":
        sentences.append("Static recordings were only checked: nothing in them was repaired or filled.")
    else:
        sentences += [*_mesh(stages, citations), *_sought(stages, citations)]
        sentences += [*(_repairs(stages) if repaired else ()), *_reported(stages), *_unmeasured(stages)]
        sentences += [
            *(filling_sentences(stages["fill"], citations, pooled=pooled) if filled and "fill" in stages else ()),
            *_decisions(stages),
        ]
        if filled or repaired:
            sentences.append(
                "Changed samples, and no others, were overwritten in a copy of each file, which was then compared with the "
                "original byte by byte."
            )
    return {"text": " ".join(sentences), "references": citations.keys}


def _place(stage: str, stages: Stages) -> str:
    """Where a detector looks; empty where that is not known."""
    return PRESETS.get(stages[stage].get("preset", ""), PLACES.get(stage, ""))


def _mesh(stages: Stages, citations: Citations) -> Iterator[str]:
    """How the mesh was inferred."""
    if "mesh" in stages:
        yield (
            "A functional body mesh (rigid segments of markers, connected in a tree) was inferred from each subject's "
            f"recordings {citations.cite('mesh')}."
        )


def _classes_sought(stages: Stages) -> list[ArtifactClass]:
    """The classes that were looked for to be repaired."""
    return [
        own
        for own in ARTIFACTS
        if own.stage in stages and not own.unmeasured and not own.reported and own.origin != "adopted"
    ]


def _sought(stages: Stages, citations: Citations) -> Iterator[str]:
    """Which artifacts were detected, and where."""
    sought = _classes_sought(stages)
    if not sought:
        return
    parts = [
        f"{enumeration([own.plural for own in group])}{f' ({place})' if place else ''}"
        for place, group in groupby(sought, key=lambda own: _place(own.stage, stages))
    ]
    yield f"Artifacts were detected in the order {'; '.join(parts)} {citations.cite('artifacts')}."


def _repairs(stages: Stages) -> Iterator[str]:
    """How artifacts were repaired."""
    if not _classes_sought(stages):
        return
    if published := list(_published_repairs(stages)):
        yield f"They were repaired by one method for each class, as published: {enumeration(published)}."
        if not stages["repair"].get("objections", True):
            yield "No repair was refused; where findings of several classes overlapped, the samples were set to missing."
    elif "repair" in stages:
        yield (
            f"They were repaired by class{limits(stages['repair'])}, where the repair brought the distances to neighbouring "
            "markers nearer to usual; samples without a reliable repair were set to missing where these distances "
            "contradicted them, and were left otherwise."
        )


def _reported(stages: Stages) -> Iterator[str]:
    """Which classes were only reported."""
    if not _classes_sought(stages):
        return
    # Published detectors look for the first class alone.
    left = [
        own
        for own in ARTIFACTS
        if own.reported
        and not (own.origin == "adopted" and _adopts(stages))
        and stages.get(own.stage, {"preset": ""}).get("preset", "default") == "default"
    ]
    if left:
        text = enumeration([artifact.plural for artifact in left])
        yield f"{text[0].upper()}{text[1:]} were reported, and left as measured unless their repair was asked for."


def _published_repairs(stages: Stages) -> Iterator[str]:
    """The classes with the one published method that repairs each; nothing where any has another, or several."""
    methods = stages.get("repair", {}).get("methods", {})
    sought = [own for own in ARTIFACTS if own.stage in stages and methods.get(own.stage) and not own.reported]
    single = all(len(methods[own.stage]) == 1 and methods[own.stage][0] in REPAIRS for own in sought)
    if single and all(stages[own.stage].get("preset") == "paper" for own in sought):
        for own in sought:
            yield f"{own.plural} by {REPAIRS[methods[own.stage][0]]}"


def _unmeasured(stages: Stages) -> Iterator[str]:
    """Which samples counted as missing because they were not measured."""
    found = [f"{a.plural} ({a.unmeasured})" for a in ARTIFACTS if a.unmeasured and a.stage in stages]
    if found:
        text = enumeration(found)
        yield f"{text[0].upper()}{text[1:]} were treated as missing."
    if _adopts(stages):
        yield (
            "Markers that were missing while their samples lay under an unlabelled trajectory were given these samples, where the "
            "distances to other markers left no doubt."
        )


def _adopts(stages: Stages) -> bool:
    """Whether markers were given their samples that lay under unlabelled trajectories."""
    return bool(stages.get("labels", {}).get("adopt_unlabelled"))


def _decisions(stages: Stages) -> Iterator[str]:
    """Whether a person decided anything."""
    if stages.get("fill", {}).get("decisions"):
        yield "Where a person had decided on findings, gaps or frames, the decisions of that person took precedence."
