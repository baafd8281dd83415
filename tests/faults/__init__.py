"""A test of what faults do to results, for anyone to run: `make faults`."""
