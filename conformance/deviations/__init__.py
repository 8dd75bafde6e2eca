"""Deviations: where an engine is known to differ from retail, how, why, and until when.

An entry is a promise about a failure: the case must fail in the recorded way, and no other. What fails
otherwise, passes, or has expired is red.
"""
