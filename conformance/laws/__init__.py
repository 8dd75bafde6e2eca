"""Metamorphic laws: how two questions, and the answers to them, belong together, whoever answers.

A law needs no oracle: a candidate is asked twice and held against itself. Each says under which exact
condition it holds for retail, bit for bit, and why; where rounding breaks it, it says by how much.
"""
