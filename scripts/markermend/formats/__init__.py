"""The outside world: recordings as files of the capture programs, read in and written back."""
