"""Judge one recording: what was missing, found, changed and left open, in numbers and as a page with plots.

Reads: 01_markers.parquet, mesh.json, the events, 06_repaired.parquet, 07_filled.parquet, 07_changes.parquet,
certificate.json.
Writes: 08_qc.json, page.html.
"""

from markermend.command.stage import Stage, mapping
from markermend.report import recording_report, rendering
from markermend.storage import atomic

STAGE = Stage("qc", __doc__)
STAGE.reads("markers", "trajectories as ingested")
STAGE.reads("mesh", "meshes of the subject")
STAGE.reads("events", "findings of the detectors, in their order", many=True, optional=True)
STAGE.reads("repaired", "trajectories after repair")
STAGE.reads("filled", "trajectories after filling")
STAGE.reads("changes", "what repair and filling did to each stretch")
STAGE.reads("certificate", "what changed, and that nothing else did")
STAGE.writes("qc", "the recording in numbers, as JSON")
STAGE.writes("page", "the recording for a person, as HTML")
STAGE.option("plots", int, "most plots in each of the page's two tables, worst first")
STAGE.option("context_s", float, "what a plot shows on either side of a finding, s")
STAGE.option("plot_frames", int, "most frames in a plot; a longer stretch shows every second, third, ... frame")
STAGE.option("attention", mapping, "points that make up the attention score, by what they are given for")


def work(call):
    seen = recording_report.read(call)
    summary = recording_report.summarize(seen, call.options["attention"])
    atomic.write_json(call.qc, {**summary, **recording_report.place(call.page)})
    atomic.write_text(call.page, recording_report.page(seen, summary, call.options))
    return f"{summary['status']}, {summary['changed_samples']} samples changed, attention {summary['attention']:.1f}"


def set_aside(call, note):
    summary = recording_report.summarize_aside(call.markers, call.page, note)
    atomic.write_json(call.qc, summary)
    atomic.write_text(call.page, rendering.page_aside(summary))


def main(argv=None):
    STAGE.run(work, argv, set_aside=set_aside)


if __name__ == "__main__":
    main()
