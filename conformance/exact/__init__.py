"""The exact model (extra ``exact``): retail's steps without any rounding, and how far off other models are.

Its answers are the truth that errors are measured against. They are not retail's: retail's roundings belong
to its behaviour, and a candidate conforms by repeating them.
"""
