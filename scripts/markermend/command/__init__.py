"""Stages as commands: flags, log, and what happens when a recording cannot be worked on."""
