"""How the command line ends; the numbers agree with pytest's where it has them."""

from __future__ import annotations

from typing import Final

OK: Final = 0
FAILURES: Final = 1
"""Something was compared and differs, or could not be read."""
USAGE: Final = 2
BROKEN: Final = 3
"""The candidate gave no answer to something: it crashed, hung or replied badly; what it answered is right."""
NOTHING_RAN: Final = 4
"""Nothing was compared, so nothing was shown to be right."""
CANNOT_WRITE: Final = 5
"""The results could not be written: a full disk, a folder that may not be written to, a closed pipe."""
BROKEN_OFF: Final = 130
"""Ctrl-C ended the run, as shells number it; what was known by then was shown, but it is not all."""
