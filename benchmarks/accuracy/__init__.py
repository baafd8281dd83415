"""How close filling, detection and repair come to a known truth."""
