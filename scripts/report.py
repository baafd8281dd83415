"""Put the data set into one report: every recording worst first, totals, what was set aside and why, the methods text.

Reads: 08_qc.json of every recording.
Writes: index.html, summary.tsv, plotly.min.js (the one plotting script that all pages share).
"""

import json

from markermend import report, storage
from markermend.stage import Stage

STAGE = Stage("report", __doc__)
STAGE.reads("qc", "recordings in numbers", many=True, optional=True)
STAGE.writes("index", "the report, as HTML")
STAGE.writes("summary", "one row per recording, tab-separated")
STAGE.writes("script", "the plotting script")


def work(call):
    summaries = [json.loads(path.read_text(encoding="utf-8")) for path in call.qc]
    storage.write_text(call.index, report.index(summaries))
    storage.write_text(call.summary, report.table(summaries))
    with storage.replacing(call.script) as temporary:
        temporary.write_bytes(report.plotly_script().read_bytes())
    aside = sum(summary["status"] == "set aside" for summary in summaries)
    return f"{len(summaries)} recordings, {aside} set aside"


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
