"""The cleaned recording in its own format, with the list of changes and a certificate."""
