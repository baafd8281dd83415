"""Put the data set into one report: every recording worst first, totals, what was set aside and why, the methods text.

Reads: 08_qc.json of every recording, or qc.json of every batch; the table of decisions.
Writes: index.html, summary.tsv, and what all pages share: plotly.min.js (the plotting script), data_set.js (the recordings in order, and
the decisions that there are). Where recordings are not finished, the
report names them, and the command ends with an error.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.core.recording import BadRecording
from markermend.report import data_set_file, dataset_summary, quality_files, rendering
from markermend.storage import atomic

STAGE = Stage("report", __doc__, sets_aside=False)
STAGE.reads("qc", "recordings in numbers: each in a file, or batches of them", many=True, optional=True, lenient=True)
STAGE.reads("unfinished", "the same of recordings that are not finished", many=True, optional=True, lenient=True)
STAGE.reads("decisions", "the table of decisions")
STAGE.writes("index", "the report, as HTML")
STAGE.writes("summary", "one row per recording, tab-separated")
STAGE.writes("script", "the plotting script")
STAGE.writes("data_set", "recordings and decisions, for all pages")


def work(call: Any) -> str:
    summaries, unfinished = quality_files.read(call.qc, call.facts["inputs"]["qc"])
    unfinished = sorted([*unfinished, *map(quality_files.place, call.unfinished)])
    atomic.write_text(call.index, rendering.index(summaries, unfinished))
    atomic.write_text(call.summary, dataset_summary.table(summaries))
    decisions = data_set_file.read_decisions(call.decisions)
    atomic.write_text(call.data_set, data_set_file.data_set_script(summaries, decisions))
    with atomic.replacing(call.script) as temporary:
        temporary.write_bytes(rendering.plotly_script().read_bytes())
    if unfinished:
        raise BadRecording(f"{len(unfinished)} not finished, among them {unfinished[0]}: run again")
    aside = sum(summary["status"] == "set aside" for summary in summaries)
    return f"{len(summaries)} recordings, {aside} set aside"


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
