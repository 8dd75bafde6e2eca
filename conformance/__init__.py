"""The conformance suite: cases, candidates, comparison and reports.

`pytest conformance` runs it; `conformance --help` is its command line.
"""
