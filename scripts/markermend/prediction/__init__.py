"""Where should a marker be, and how sure is that? One interface, used by detection, repair and filling."""
