"""Which branches of the oracle the cases reach, and why the others are not reached.

A branch is told by its function, the text of its condition and the way it goes, not by line numbers, so
that what is recorded about it survives edits of the lines around it.
"""
