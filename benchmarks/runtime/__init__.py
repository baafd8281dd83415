"""How long stages and workflow take, and how much memory they need."""
