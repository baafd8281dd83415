"""The command `markermend`: what people type, and what they see while it works."""
