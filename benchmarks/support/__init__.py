"""What several benchmarks share: default options, cases with a known truth, runs of one stage, tables."""
