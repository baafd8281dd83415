"""What a run is made of: recordings, decisions, configuration, and the code that results depend on."""
