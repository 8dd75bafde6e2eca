"""`conformance bench`: how fast the engine is, and what its speed is bought with.

Speeds are never compared across runs: two implementations take turns at the same work in one process,
their answers are compared first, and what is reported is the median of the ratios with its spread.
"""
