"""Check whether every result is as it was written, and every original as it was read: `verify.py RESULTS`.

Reads: the results with their checksums, the originals. Writes: a table of what differs, to stdout.
"""

import sys

from markermend.command.verification import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
