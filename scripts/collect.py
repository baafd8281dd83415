"""Put the figures of a batch of recordings into one file: the report is not made of thousands.

Reads: 08_qc.json of the recordings.
Writes: qc.json, their contents in the order of subjects and recordings.
"""

import json
from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.storage import atomic

STAGE = Stage("collect", __doc__, sets_aside=False)
STAGE.reads("qc", "recordings in numbers", many=True)
STAGE.writes("batch", "all of them")


def work(call: Any) -> str:
    summaries = [json.loads(path.read_text(encoding="utf-8")) for path in call.qc]
    summaries.sort(key=lambda summary: (summary["subject"], summary["recording"]))
    atomic.write_json(call.batch, summaries)
    return f"{len(summaries)} recordings"


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
