"""Which marker each label is on: exchanges from one frame to the next and by level, labels on something else, and missing ones."""
