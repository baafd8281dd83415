"""Gap filling by model averaging."""
