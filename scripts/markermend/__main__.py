"""`python -m markermend` is the command `markermend`."""

import sys

from markermend.terminal.command_line import main

if __name__ == "__main__":
    sys.exit(main())
