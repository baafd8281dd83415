"""The sources of the documentation site, and what checks and illustrates it."""
