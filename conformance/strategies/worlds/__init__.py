"""Worlds for random queries: houses on rolling, steep and flooded land, and things that stand about.

A few dozen sites are made once and shared, so that a world costs nothing to draw and every candidate
compiles it once; what a query needs besides (an obstacle ahead of the mover) is added to a copy.
"""
