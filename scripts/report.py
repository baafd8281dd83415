"""Put the data set into one report: every recording worst first, totals, what was set aside and why, the methods text.

Reads: 08_qc.json of every recording, or qc.json of every batch.
Writes: index.html, summary.tsv, plotly.min.js (the one plotting script that all pages share).
"""

import json
from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.report import dataset_summary, rendering
from markermend.storage import atomic

STAGE = Stage("report", __doc__, sets_aside=False)
STAGE.reads("qc", "recordings in numbers: each in a file, or batches of them", many=True, optional=True)
STAGE.writes("index", "the report, as HTML")
STAGE.writes("summary", "one row per recording, tab-separated")
STAGE.writes("script", "the plotting script")


def work(call: Any) -> str:
    contents = [json.loads(path.read_text(encoding="utf-8")) for path in call.qc]
    summaries = [summary for content in contents for summary in (content if isinstance(content, list) else [content])]
    atomic.write_text(call.index, rendering.index(summaries))
    atomic.write_text(call.summary, dataset_summary.table(summaries))
    with atomic.replacing(call.script) as temporary:
        temporary.write_bytes(rendering.plotly_script().read_bytes())
    aside = sum(summary["status"] == "set aside" for summary in summaries)
    return f"{len(summaries)} recordings, {aside} set aside"


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
