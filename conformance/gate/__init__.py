"""The gate: everything that a release of an engine is held to, in one run, with evidence of it."""
