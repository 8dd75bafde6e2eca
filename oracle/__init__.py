"""Retail, line by line: the standard library only, one function per retail function.

Every numbered step of the specification (``docs/retail``) is a comment label here.
"""
