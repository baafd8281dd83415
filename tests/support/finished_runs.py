"""What a finished run leaves, as far as it is described to be published."""

import json

from markermend.storage import output_checksums
from markermend.storage.atomic import sha256, write_list

RUN = {
    "markermend": "0.1.0",
    "commit": None,
    "started": "2026-01-02T03:04:05+00:00",
    "finished": "2026-01-02T03:09:05+00:00",
}


def finish(results, places, besides=()):
    """Write results of recordings, by their folders with the places of their cleaned files; and what else was written for the first."""
    for name, place in places.items():
        folder, cleaned = results / name, results / "cleaned" / place
        folder.mkdir(parents=True, exist_ok=True)
        cleaned.parent.mkdir(parents=True, exist_ok=True)
        cleaned.write_text(place)
        stated = {
            "source": cleaned.name,
            "original_sha256": "ab" * 32,
            "cleaned_sha256": sha256(cleaned),
            "changed_samples": 3,
            "cleaned": f"../../cleaned/{place}",
        }
        (folder / "certificate.json").write_text(json.dumps(stated))
        for table in ("changes.tsv", "originals.parquet"):
            (folder / table).write_text(table)
        written = [*(folder / own for own in ("certificate.json", "changes.tsv", "originals.parquet")), cleaned]
        written += [results / "cleaned" / own for own in besides] if name == next(iter(places)) else []
        output_checksums.write("export", written)
    report = results / "report"
    report.mkdir(exist_ok=True)
    (report / "provenance.json").write_text(json.dumps(RUN))
    for page in ("index.html", "summary.tsv"):
        (report / page).write_text(page)
    output_checksums.write("report", [report / "index.html", report / "summary.tsv"])
    write_list(str(report / "logs/recordings.txt"), [str(results / name / "08_qc.json") for name in places])
    return results
