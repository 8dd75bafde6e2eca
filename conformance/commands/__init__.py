"""The command line's subcommands, one module each.

A module has ``HELP`` (a sentence), ``EXAMPLES`` (lines to copy), ``configure(parser)`` and ``run(args)``,
which returns the exit code. What is slow to import is imported when the command runs.
"""
