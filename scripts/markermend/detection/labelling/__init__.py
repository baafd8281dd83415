"""Which marker each label is on: exchanges from one frame to the next and by level, and labels on something else."""
