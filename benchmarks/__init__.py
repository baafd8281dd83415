"""Measurements of accuracy and run time; every script says in its first lines what it reads and prints."""
