"""Tables in text files: TRC, CSV and TSV."""
