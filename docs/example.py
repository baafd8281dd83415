"""The example of the page on the Python interface: it reads walk.c3d and turn.c3d, and writes walk_cleaned.c3d and what belongs to it."""

from markermend import api

# Read the recordings of a subject, infer the body mesh, and look for artifacts.
walk, turn = api.read("walk.c3d"), api.read("turn.c3d")
mesh = api.infer_mesh([walk, turn])
findings = api.detect(walk, mesh)
for stage, events in findings.items():
    for event in events:
        print(stage, event.marker, walk.first_frame + event.start, walk.first_frame + event.stop - 1)

# Clean it, with options of your own. Filling learns from poses of the other recording, too.
options = api.Options.read({"fill": {"max_gap_s": 0.5}, "protect": ["Prop:*"]})
cleaned, _ = api.clean_subject([walk, turn], mesh, options)
for change in cleaned.changes:
    print(change.kind, change.marker, change.outcome, change.method, change.expected_error_mm)
print(cleaned.warnings)

# Decide that what was found at one place is no artifact.
decision = {"marker": cleaned.changes[0].marker, "decision": "reject", "note": "seen on the video"}
decided = api.clean(walk, mesh, options, decisions=[decision])
certificate = api.write(
    decided, "walk.c3d", "walk_cleaned.c3d", changes="walk_changes.tsv", originals="walk_originals.parquet"
)
print(certificate["changed_samples"], certificate["other_bytes_equal"])

# Take everything back: the copy is the original, bit for bit.
restored = api.undo("walk_cleaned.c3d", "walk_again.c3d", originals="walk_originals.parquet", certificate=certificate)
print(restored.whole)
