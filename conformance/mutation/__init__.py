"""Small mistakes planted in the oracle one at a time, and what of the suite notices them.

The share that is noticed is the suite's mutation score. Mutants are told by their function and by what is
written in place of what, not by line numbers, so that what is recorded about them survives edits of the
lines around them.
"""
