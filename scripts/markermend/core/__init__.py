"""What a recording, an event, a mesh and a decision are."""
