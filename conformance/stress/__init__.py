"""Numerical stress: sweeps that push the same questions towards where float32 gives way.

Each family is a set of sweeps. At every severity retail, the same with other roundings, and the candidate are
held against exact arithmetic; the candidate must also be retail, bit for bit.
"""
