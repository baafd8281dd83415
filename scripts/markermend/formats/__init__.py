"""Recordings as files of the capture programs: read, ingested, and written back with edited samples."""
