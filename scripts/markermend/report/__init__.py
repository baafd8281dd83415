"""The report on a data set and the page of each recording."""
