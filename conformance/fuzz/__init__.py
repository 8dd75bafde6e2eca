"""Fuzzing of what reads input from strangers: bytes in, a located error or valid data out, nothing else.

A target is a function of bytes. Whatever it raises is a finding; that it returns says nothing is wrong:
either the input was refused with a typed and located error, or it was accepted and stood up to an
independent check, so that nothing is accepted silently.
"""
