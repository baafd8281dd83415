"""Judge one recording: what was missing, found, changed and left open, in numbers and as a page with plots.

Reads: 01_markers.parquet, mesh.json, the events, 06_repaired.parquet, 07_filled.parquet, 07_changes.parquet,
certificate.json.
Writes: 08_qc.json, page.html.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.core.recording import SetAside
from markermend.options.general import DecisionOptions
from markermend.options.reporting import QcOptions
from markermend.report import evidence, recording_report, rendering
from markermend.storage import atomic

STAGE = Stage("qc", __doc__, QcOptions, DecisionOptions)
STAGE.reads("markers", "trajectories as ingested")
STAGE.reads("mesh", "meshes of the subject")
STAGE.reads("events", "findings of the detectors, in their order", many=True, optional=True)
STAGE.reads("repaired", "trajectories after repair")
STAGE.reads("filled", "trajectories after filling")
STAGE.reads("changes", "what repair and filling did to each stretch")
STAGE.reads("certificate", "what changed, and that nothing else did")
STAGE.writes("qc", "the recording in numbers, as JSON")
STAGE.writes("page", "the recording for a person, as HTML")
STAGE.keeps_outputs()


def work(call: Any) -> str:
    seen = evidence.read_evidence(call)
    summary = recording_report.summarize(seen, call.options.attention)
    atomic.write_json(call.qc, {**summary, **recording_report.place(call.page)})
    atomic.write_text(call.page, recording_report.page(seen, summary, call.options))
    return f"{summary['status']}, {summary['changed_samples']} samples changed, attention {summary['attention']:.1f}"


def set_aside(call: Any, note: SetAside) -> None:
    summary = recording_report.summarize_aside(call.markers, call.certificate, call.page, note)
    atomic.write_json(call.qc, summary)
    atomic.write_text(call.page, rendering.page_aside(summary))


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv, set_aside=set_aside)


if __name__ == "__main__":
    main()
