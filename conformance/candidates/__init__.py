"""Who can be tested: the engine, the oracle itself, and candidates that are wrong on purpose."""
