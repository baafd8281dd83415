"""What the program and the pages must agree on about the table of decisions: cases of both, read by the tests of Python and of JavaScript."""

import json
from pathlib import Path

CASES = json.loads(Path(__file__).with_suffix(".json").read_text(encoding="utf-8"))
"""`cells`, a text and the cell that it is written as; `decisions`, `markers` and `frames` of two lines, and whether these contradict each other
where all else is the same."""
