"""The report that people look at in a browser: one file, without network, safe to open."""
