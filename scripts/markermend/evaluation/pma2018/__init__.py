"""The experiments of the model averaging paper (tits2018)."""
