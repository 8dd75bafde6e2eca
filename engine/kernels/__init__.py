"""Compiled functions, one file per family of retail's classes.

Conventions of every kernel here:

- ``wf`` and ``wi`` are a world's float64 and int64 arrays, read-only; ``s`` is the float64 row of
  the query. Their layout is in `engine.layout`.
- Arithmetic is float64, as in retail's registers; ``f32`` is a store to a float32 field. All arrays
  hold float32 values. Expressions keep the grouping of the specification.
- Points and vectors are passed as three numbers and returned as tuples; a position is an array and
  the offset at which it begins.
- Docstrings cite the retail function and the numbered steps of ``docs/retail``.
"""
